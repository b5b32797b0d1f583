// What a gas of stability/ is held against: how long it is watched, and the event-driven simulator
// from the same start.
#pragma once

#include "common/scene.h"
#include "stability/scenes.h"
#include "truth/balls.h"

namespace ballpit::stability {

/// s: so many collisions a ball if the gas is elastic; if not, Haff's time, in which it should lose
/// three quarters of its energy. By Enskog's rate.
double gasSeconds(const Gas& gas, double collisions);

/// The balls of a world without gravity and damping after `seconds`, from collision to collision.
truth::Balls trueEnd(const Scene& scene, double seconds);

/// J, of the same.
double trueEnergy(const Scene& scene, double seconds);

}  // namespace ballpit::stability
