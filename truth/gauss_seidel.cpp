// Implements the sequential reference step.
#include "truth/gauss_seidel.h"

#include <cmath>
#include <utility>

namespace ballpit::truth {

void kick(Ball& ball, const StepSettings& s) {
    ball.velocity += s.dt * s.gravity;
    ball.velocity = (1 - s.damping * s.dt) * ball.velocity;
}

GaussSeidel::GaussSeidel(Balls balls, const StepSettings& settings)
    : balls_(std::move(balls)), settings_(settings), walls_(wallsOf(settings.walls)) {}

/// Back onto the wall; it bounces only if it moves on outwards.
void GaussSeidel::bounceOffWalls(Ball& ball) {
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = settings_.walls.lower[axis] + ball.radius;
        const double upper = settings_.walls.upper[axis] - ball.radius;
        double &x = ball.position[axis], &v = ball.velocity[axis];
        const bool below = x<lower, above = x> upper;
        if (!below && !above) continue;
        x = below ? lower : upper;
        const bool bounces = std::abs(v) >= settings_.restitutionThreshold;
        if (below == (v < 0)) v *= bounces ? -ball.restitution : 0;
    }
}

/// A contact was found at the start of its pass, and counts to its end; overlap and speed are as
/// its forerunners left them.
void GaussSeidel::resolve(const Contact& contact) {
    const Geometry now = geometryOf(contact, balls_, walls_);
    const double inverseMass = inverseMassSum(contact, balls_);
    const double separation = separationSpeed(contact, balls_, now.normal);
    if (separation < 0) {
        const bool bounces = -separation >= settings_.restitutionThreshold;
        const double e = bounces ? restitutionOf(contact, balls_) : 0;
        applyImpulse(contact, balls_, (-(1 + e) * separation / inverseMass) * now.normal);
        if (contact.a >= 0) ++counts_.impulses;
    }
    if (now.penetration > 0)
        applyPush(contact, balls_,
                  (settings_.projection * now.penetration / inverseMass) * now.normal);
}

void GaussSeidel::step() {
    const bool wallsFirst = settings_.wallTurn == WallTurn::oncePerStep;
    for (Ball& ball : balls_) {
        kick(ball, settings_);
        ball.position += settings_.dt * ball.velocity;
        if (wallsFirst) bounceOffWalls(ball);
    }
    for (int pass = 0; pass < settings_.passes; ++pass) {
        std::vector<Contact> contacts =
            wallsFirst ? touchingBalls(balls_) : touchingEverything(balls_, walls_);
        counts_.visits += contacts.size();
        inOrder(contacts, settings_.order, settings_.seed + passesDone_++);
        for (const Contact& contact : contacts) resolve(contact);
    }
}

}  // namespace ballpit::truth
