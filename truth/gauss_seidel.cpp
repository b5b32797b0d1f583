// Implements the sequential reference step.
#include "truth/gauss_seidel.h"

#include <cstddef>
#include <utility>

#include "common/random.h"

namespace ballpit::truth {

namespace {

void inOrder(std::vector<Contact>& contacts, ContactOrder order, std::uint64_t seed) {
    if (order == ContactOrder::falling) std::reverse(contacts.begin(), contacts.end());
    if (order != ContactOrder::random) return;
    Random random(seed);  // Fisher and Yates; the bias of the remainder is below 1e-15
    for (std::size_t k = contacts.size(); k > 1; --k)
        std::swap(contacts[k - 1], contacts[random.next() % k]);
}

double restitutionOf(const Contact& contact, const Balls& balls) {
    const Ball& b = balls[static_cast<std::size_t>(contact.b)];
    return contact.a < 0 ? b.restitution
                         : combinedRestitution(balls[static_cast<std::size_t>(contact.a)], b);
}

}  // namespace

void moveFreely(Ball& ball, const StepSettings& s) {
    ball.velocity += s.dt * s.gravity;
    ball.velocity = (1 - s.damping * s.dt) * ball.velocity;
    ball.position += s.dt * ball.velocity;
}

GaussSeidel::GaussSeidel(Balls balls, const StepSettings& settings)
    : balls_(std::move(balls)), settings_(settings), walls_(wallsOf(settings.walls)) {}

/// Back onto the wall; it bounces only if it moves on outwards.
void GaussSeidel::bounceOffWalls(Ball& ball) {
    for (int axis = 0; axis < 3; ++axis) {
        const double lower = settings_.walls.lower[axis] + ball.radius;
        const double upper = settings_.walls.upper[axis] - ball.radius;
        double &x = ball.position[axis], &v = ball.velocity[axis];
        const bool below = x < lower, above = x > upper;
        if (!below && !above) continue;
        x = below ? lower : upper;
        const bool bounces = std::abs(v) >= settings_.restitutionThreshold;
        if (below == (v < 0)) v *= bounces ? -ball.restitution : 0;
    }
}

/// A contact was found at the start of its pass, and counts to its end; overlap and speed are as its
/// forerunners left them.
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
        applyPush(contact, balls_, (settings_.projection * now.penetration / inverseMass) * now.normal);
}

void GaussSeidel::step() {
    for (Ball& ball : balls_) {
        moveFreely(ball, settings_);
        if (settings_.wallTurn == WallTurn::oncePerStep) bounceOffWalls(ball);
    }
    for (int pass = 0; pass < settings_.passes; ++pass) {
        std::vector<Contact> contacts;
        if (settings_.wallTurn == WallTurn::everyPass) contacts = touchingWalls(balls_, walls_);
        const std::vector<Contact> pairs = touchingBalls(balls_);
        contacts.insert(contacts.end(), pairs.begin(), pairs.end());
        inOrder(contacts, settings_.order, settings_.seed + passesDone_++);
        if (pass == 0) deepestFound_ = 0;
        for (const Contact& contact : contacts) {
            if (pass == 0)
                deepestFound_ = std::max(deepestFound_,
                                         geometryOf(contact, balls_, walls_).penetration);
            resolve(contact);
        }
        counts_.pairVisits += pairs.size();
    }
}

}  // namespace ballpit::truth
