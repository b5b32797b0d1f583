// Implements the event-driven simulator: predictions, and what each kind of event does.
#include "truth/event_driven.h"

#include <cstddef>
#include <stdexcept>
#include <utility>

#include "truth/event_times.h"

namespace ballpit::truth {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

EventDriven::EventDriven(Balls balls, const EventSettings& settings)
    : settings_(settings),
      balls_(std::move(balls)),
      cells_(balls_, settings_.box, settings_.periodic),
      asOf_(balls_.size(), 0.0),
      lastCollision_(balls_.size(), -never),
      collisionCount_(balls_.size(), 0) {
    if (settings_.periodic && length(settings_.gravity) > 0)
        throw std::invalid_argument("gravity in a periodic box: the balls would fall for ever");
    predictAll();
}

Ball EventDriven::asOfNow(int k) const {
    Ball ball = balls_[at(k)];
    const double t = now_ - asOf_[at(k)];
    ball.position += t * ball.velocity + (0.5 * t * t) * settings_.gravity;
    ball.velocity += t * settings_.gravity;
    return ball;
}

void EventDriven::advance(int k) {
    balls_[at(k)] = asOfNow(k);
    asOf_[at(k)] = now_;
}

// ---- predictions

/// From nothing: at the start, and when most events in the queue will never happen.
void EventDriven::predictAll() {
    queue_ = Queue();
    for (int k = 0; k < static_cast<int>(balls_.size()); ++k) {
        advance(k);
        predictPairs(k);
        predictFaces(k);
    }
}

/// `a` is up to date. Gravity is the same for both, so it drops out at a common moment.
void EventDriven::predictPair(int a, int b) {
    const Ball &ball = balls_[at(a)], other = asOfNow(b);
    const double wait = timeToTouch(cells_.lineBetween(ball.position, other.position),
                                    other.velocity - ball.velocity, ball.radius + other.radius);
    if (wait == never) return;
    queue_.push(
        {now_ + wait, Kind::collision, a, b, collisionCount_[at(a)], collisionCount_[at(b)]});
}

/// With the balls of all cells from `from` to `to`, both included.
void EventDriven::predictPairsIn(int ball, Cell from, Cell to) {
    for (int z = from.z; z <= to.z; ++z)
        for (int y = from.y; y <= to.y; ++y)
            for (int x = from.x; x <= to.x; ++x) {
                Cell cell{x, y, z};
                if (!cells_.wrap(cell)) continue;
                for (const int other : cells_.members(cell))
                    if (other != ball) predictPair(ball, other);
            }
}

void EventDriven::predictPairs(int ball) {
    const Cell c = cells_.cellOf(ball);
    predictPairsIn(ball, {c.x - 1, c.y - 1, c.z - 1}, {c.x + 1, c.y + 1, c.z + 1});
}

/// The face that the ball reaches first: of its cell, or where no cell follows, the wall.
void EventDriven::predictFaces(int k) {
    const Ball& ball = balls_[at(k)];
    Event first{never, Kind::wall, k, 0, collisionCount_[at(k)], 0};
    for (int face = 0; face < faceCount; ++face) {
        const int axis = axisOf(face), outwards = directionOf(face);
        const Cell cell = cells_.cellOf(k);
        Cell next = cell;
        next[axis] += outwards;
        const Kind kind = cells_.wrap(next) ? Kind::crossing : Kind::wall;
        double distance = outwards * (cells_.facePosition(cell, face) - ball.position[axis]);
        if (kind == Kind::wall) distance -= ball.radius;
        const double time = now_ + timeToLeave(distance, outwards * ball.velocity[axis],
                                               outwards * settings_.gravity[axis]);
        if (time < first.time) {
            first.time = time;
            first.kind = kind;
            first.partner = face;
        }
    }
    if (first.time < never) queue_.push(first);
}

// ---- events

/// Not if one of its balls has collided since it was predicted.
bool EventDriven::happens(const Event& event) const {
    return event.ballCount == collisionCount_[at(event.ball)] &&
           (event.kind != Kind::collision ||
            event.partnerCount == collisionCount_[at(event.partner)]);
}

void EventDriven::handle(const Event& event) {
    if (event.kind == Kind::crossing) cross(event.ball, event.partner);
    if (event.kind == Kind::wall) collideWithWall(event.ball, event.partner);
    if (event.kind == Kind::collision) collidePair(event.ball, event.partner);
}

/// The ball's predictions stay true; only the nine cells that came near are new to it.
void EventDriven::cross(int k, int face) {
    advance(k);
    const int axis = axisOf(face);
    balls_[at(k)].position[axis] += cells_.cross(k, face);
    const Cell c = cells_.cellOf(k);
    Cell from{c.x - 1, c.y - 1, c.z - 1}, to{c.x + 1, c.y + 1, c.z + 1};
    from[axis] = to[axis] = c[axis] + directionOf(face);
    predictPairsIn(k, from, to);
    predictFaces(k);
}

/// The restitution of a collision now, by the TC model; notes the collision.
double EventDriven::restitutionNow(std::initializer_list<int> balls, double restitution) {
    bool soon = false;
    for (const int k : balls) {
        if (now_ - lastCollision_[at(k)] < settings_.contactTime) soon = true;
        lastCollision_[at(k)] = now_;
        ++collisionCount_[at(k)];
    }
    if (soon && restitution < 1) ++counts_.elasticByContactTime;
    return soon ? 1 : restitution;
}

void EventDriven::collideWithWall(int k, int face) {
    advance(k);
    balls_[at(k)].velocity[axisOf(face)] *= -restitutionNow({k}, balls_[at(k)].restitution);
    ++counts_.wallCollisions;
    predictPairs(k);
    predictFaces(k);
}

void EventDriven::collidePair(int a, int b) {
    advance(a);
    advance(b);
    Ball &first = balls_[at(a)], &second = balls_[at(b)];
    const Vector line = cells_.lineBetween(first.position, second.position);
    const double distance = length(line), reach = first.radius + second.radius;
    if (distance < reach * (1 - roundingShare)) ++counts_.overlapping;
    const double restitution = restitutionNow({a, b}, combinedRestitution(first, second));
    counts_.virial += distance * collide(first, second, (1 / distance) * line, restitution);
    ++counts_.collisions;
    for (const int k : {a, b}) {
        predictPairs(k);
        predictFaces(k);
    }
}

void EventDriven::runUntil(double time, std::uint64_t mostCollisions) {
    const auto happened = [&] { return counts_.collisions + counts_.wallCollisions; };
    const std::uint64_t before = happened();
    while (!queue_.empty() && queue_.top().time <= time) {
        if (happened() - before >= mostCollisions) return;
        const Event event = queue_.top();
        queue_.pop();
        if (!happens(event)) continue;
        now_ = std::max(now_, event.time);
        handle(event);
        if (queue_.size() > 100 * balls_.size() + 1000) predictAll();
    }
    if (time < never) now_ = std::max(now_, time);
}

void EventDriven::resetCounts() {
    counts_ = {};
    counts_.since = now_;
}

// ---- what it says

Balls EventDriven::balls() const {
    Balls result;
    for (int k = 0; k < static_cast<int>(balls_.size()); ++k) result.push_back(asOfNow(k));
    return result;
}

int EventDriven::invalidStates() const {
    const Balls now = balls();
    int invalid = 0;
    for (std::size_t a = 0; a < now.size(); ++a) {
        if (!cells_.holds(now[a]) || !isFinite(now[a].velocity)) ++invalid;
        for (std::size_t b = a + 1; b < now.size(); ++b)
            if (length(cells_.lineBetween(now[a].position, now[b].position)) <
                (now[a].radius + now[b].radius) * (1 - roundingShare))
                ++invalid;
    }
    return invalid;
}

double EventDriven::meanFreeTime() const {
    return (now_ - counts_.since) * static_cast<double>(balls_.size()) /
           (2 * static_cast<double>(counts_.collisions));
}

double EventDriven::compressibility() const {
    // P V = N T + virial / (3 t), the virial theorem for impulses.
    const double thermal = 3 * static_cast<double>(balls_.size()) * temperature(balls());
    return 1 + counts_.virial / (thermal * (now_ - counts_.since));
}

}  // namespace ballpit::truth
