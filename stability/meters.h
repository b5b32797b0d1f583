// The meters of question.h, one for each kind of error.
#pragma once

#include <vector>

#include "12_speed_and_accuracy/errors.h"
#include "stability/question.h"

namespace ballpit::stability {

/// sqrt of the mean over time of (E - E0)^2, over E0; E: the shadow energy.
class EnergyMeter : public Meter {
public:
    EnergyMeter(const Scene& scene, double dt) : Meter(scene, dt), drift_(startEnergy()) {}
    double error() const override { return drift_.rms(); }

protected:
    void observe(const Spheres& now, double) override { drift_.add(energy(now)); }

private:
    EnergyDrift drift_;
};

/// An error that the last state alone decides.
class LastStateMeter : public Meter {
public:
    using Meter::Meter;
    double error() const override { return error_; }

protected:
    virtual double errorOf(const Spheres& now) const = 0;
    void observe(const Spheres& now, double) override { error_ = errorOf(now); }

private:
    double error_ = 0;
};

/// The larger of |E / E0 - 1| and |p - p0| / sqrt(2 E0 M), at the end.
class ConservationMeter : public LastStateMeter {
public:
    using LastStateMeter::LastStateMeter;

protected:
    double errorOf(const Spheres& now) const override;
};

/// |E / E_true - 1| at the end; E_true: the event-driven simulator from the same start.
class CoolingMeter : public Meter {
public:
    using Meter::Meter;
    double error() const override;

protected:
    void observe(const Spheres& now, double time) override;

private:
    double energy_ = 0, time_ = 0;
};

/// sqrt of the mean over time and balls of d^2, over the mean radius; d: overlaps of balls and
/// walls.
class OverlapMeter : public Meter {
public:
    using Meter::Meter;
    double error() const override;

protected:
    void observe(const Spheres& now, double) override;

private:
    double squares_ = 0, frames_ = 0;
};

/// The deepest overlap in the last second, over r, of balls on top of each other.
class RestingMeter : public Meter {
public:
    RestingMeter(const Scene& scene, double dt, double seconds)
        : Meter(scene, dt), from_(seconds - 1) {}
    double error() const override { return deepest_; }

protected:
    void observe(const Spheres& now, double time) override;
    bool hasLostOne(const Spheres& now) const override;

private:
    double from_, deepest_ = 0;
};

/// The largest distance of a ball's velocity, m/s, from what Newton's cradle ends with.
class CradleMeter : public LastStateMeter {
public:
    using LastStateMeter::LastStateMeter;

protected:
    double errorOf(const Spheres& now) const override;
};

/// Root mean square over all pairs: by how many degrees the relative velocity is turned wrongly.
class AngleMeter : public LastStateMeter {
public:
    using LastStateMeter::LastStateMeter;

protected:
    double errorOf(const Spheres& now) const override;
};

/// sqrt of the mean over all bullets of (p - p_true)^2, over the mean of p_true; p: the momentum
/// along x of what a bullet has hit, at the end. In body order, a ball that moves at the start is a
/// bullet, and those at rest behind it are what is in its way.
class HandedOnMeter : public Meter {
public:
    using Meter::Meter;
    double error() const override;

protected:
    void observe(const Spheres& now, double time) override;

private:
    std::vector<double> momenta_;
    double time_ = 0;
};

}  // namespace ballpit::stability
