// Asks the closed forms and the event-driven simulator.
#include "stability/gas_truth.h"

#include <numbers>

#include "truth/event_driven.h"
#include "truth/kinetic_theory.h"

namespace ballpit::stability {

namespace {

truth::Vector widened(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

double gasSeconds(const Gas& gas, double collisions) {
    const double rate =
        truth::enskogRate(gas.volumeShare * 6 / std::numbers::pi, 2 * ballRadius, 1, 1);
    return gas.restitution < 1 ? truth::haffTime(gas.restitution, rate) : collisions / rate;
}

truth::Balls trueEnd(const Scene& scene, double seconds) {
    truth::Balls balls;
    const Spheres& s = scene.spheres;
    for (std::size_t k = 0; k < s.count(); ++k)
        balls.push_back({widened(s.positions[k]), widened(s.velocities[k]), s.radii[k], s.masses[k],
                         s.restitutions[k]});
    truth::EventDriven simulator(balls,
                                 {.box = {widened(scene.bounds.lower), widened(scene.bounds.upper)},
                                  .periodic = scene.periodic});
    simulator.runUntil(seconds);
    return simulator.balls();
}

double trueEnergy(const Scene& scene, double seconds) {
    return truth::kineticEnergy(trueEnd(scene, seconds));
}

}  // namespace ballpit::stability
