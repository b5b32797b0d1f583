// Implements the scheme with accumulated impulses.
#include "truth/accumulated.h"

namespace ballpit::truth {

Accumulated::Accumulated(Balls balls, const StepSettings& settings, double slop, bool warmStart)
    : balls_(std::move(balls)),
      settings_(settings),
      slop_(slop),
      warmStart_(warmStart),
      walls_(wallsOf(settings.walls)) {}

double Accumulated::impulseOf(int a, int b) const {
    const auto found = impulses_.find({a, b});
    return found == impulses_.end() ? 0 : found->second;
}

/// The targets belong to the velocities before any impulse of this step.
std::vector<Accumulated::Solved> Accumulated::findContacts() const {
    std::vector<Solved> result;
    for (const Contact& contact : touchingEverything(balls_, walls_)) {
        const Vector normal = geometryOf(contact, balls_, walls_).normal;
        const double approach = -separationSpeed(contact, balls_, normal);
        const bool bounces = approach > 0 && approach >= settings_.restitutionThreshold;
        const double target = bounces ? restitutionOf(contact, balls_) * approach : 0;
        const double start = warmStart_ ? impulseOf(contact.a, contact.b) : 0;
        result.push_back({contact, normal, target, start});
    }
    inOrder(result, settings_.order, settings_.seed + stepsDone_);
    return result;
}

/// One contact's turn. The sum is clamped, not the change: a push too many is taken back.
void Accumulated::improve(Solved& solved) {
    const double separation = separationSpeed(solved.contact, balls_, solved.normal);
    const double wanted =
        solved.impulse + (solved.target - separation) / inverseMassSum(solved.contact, balls_);
    const double change = std::max(0.0, wanted) - solved.impulse;
    solved.impulse += change;
    applyImpulse(solved.contact, balls_, change * solved.normal);
}

void Accumulated::pushApart(const std::vector<Solved>& contacts) {
    for (const Solved& solved : contacts) {
        const Geometry now = geometryOf(solved.contact, balls_, walls_);
        const double excess = settings_.projection * (now.penetration - slop_);
        const double push = excess / inverseMassSum(solved.contact, balls_);
        if (excess > 0) applyPush(solved.contact, balls_, push * now.normal);
    }
}

void Accumulated::step() {
    for (Ball& ball : balls_) kick(ball, settings_);
    std::vector<Solved> contacts = findContacts();
    for (const Solved& solved : contacts)
        applyImpulse(solved.contact, balls_, solved.impulse * solved.normal);
    for (int pass = 0; pass < settings_.passes; ++pass)
        for (Solved& solved : contacts) improve(solved);

    for (Ball& ball : balls_) ball.position += settings_.dt * ball.velocity;
    for (int pass = 0; pass < 2; ++pass) pushApart(contacts);

    impulses_.clear();
    for (const Solved& solved : contacts)
        impulses_[{solved.contact.a, solved.contact.b}] = solved.impulse;
    ++stepsDone_;
}

}  // namespace ballpit::truth
