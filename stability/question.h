// What each charted scene asks, as a number: the scenes of the catalogue that have a truth or an
// error measure, what their error is, and the meter that reads it off a run. Any engine can be
// asked: a meter sees nothing but states.
#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "common/scene.h"
#include "stability/map.h"

namespace ballpit::stability {

/// The whole steps of dt s that a run of `seconds` takes.
inline long wholeSteps(double seconds, double dt) {
    return std::lround(std::ceil(seconds / dt - 1e-6));
}

/// Reads the error off one run. Give it the state at the end of every frame (Scene::dt s; of every
/// step, if steps are longer), the start left out.
class Meter {
public:
    /// `dt`, s: the step with which the engine moves the bodies (a substep, if it has them); it
    /// sets the shadow energy.
    Meter(const Scene& scene, double dt);
    virtual ~Meter() = default;
    Meter(const Meter&) = delete;
    Meter& operator=(const Meter&) = delete;

    /// `now`: in body order; `time`, s since the start. Nothing more is read once the run has
    /// failed.
    void add(const Spheres& now, double time);

    /// Not `ok` as soon as the run has failed: a body that is no number; one outside the walls, or
    /// one that has fallen through another; half as much energy again as at the start.
    Verdict verdict() const { return verdict_; }
    bool hasFailed() const { return verdict_ != Verdict::ok; }

    /// Without unit, 0 for a perfect run; of what was added so far, NaN if that says nothing.
    virtual double error() const = 0;

protected:
    virtual void observe(const Spheres& now, double time) = 0;
    /// A reason to fail that only this scene has.
    virtual bool hasLostOne(const Spheres&) const { return false; }

    const Scene& scene() const { return scene_; }
    double energy(const Spheres& now) const;  ///< J: the shadow energy
    double startEnergy() const { return startEnergy_; }

private:
    Verdict verdictOf(const Spheres& now) const;

    Scene scene_;
    float dt_;
    double startEnergy_;
    Verdict verdict_ = Verdict::ok;
};

struct Question {
    const char* scene;        ///< its name in the catalogue
    const char* error;        ///< what the error is, for an axis
    const char* heldAgainst;  ///< what has the error 0
    double seconds;           ///< simulated
    std::unique_ptr<Meter> (*meter)(const Scene& scene, double dt);
    /// Null: the catalogue's scene, as many balls as usual.
    Scene (*makeOwn)(std::uint64_t seed) = nullptr;
    double tolerance = 0;  ///< the catalogue's

    Scene make(std::uint64_t seed) const;
};

/// In the order of the catalogue.
std::span<const Question> questions();

/// "two_bodies, bounce, ...".
std::string questionNames();

/// By the scene's name; "666" is six_cubed. InputError, naming all, if there is none.
const Question& question(std::string_view scene);

}  // namespace ballpit::stability
