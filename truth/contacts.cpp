// Implements the search for contacts, and what acts on both sides of one.
#include "truth/contacts.h"

#include <cstddef>
#include <numeric>

namespace ballpit::truth {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

std::vector<Wall> wallsOf(const Box& box) {
    std::vector<Wall> walls;
    for (int axis = 0; axis < 3; ++axis) {
        Vector inwards;
        inwards[axis] = 1;
        walls.push_back({inwards, box.lower[axis]});
        walls.push_back({-1.0 * inwards, -box.upper[axis]});
    }
    return walls;
}

std::vector<Contact> touchingBalls(const Balls& balls) {
    std::vector<int> alongX(balls.size());
    std::iota(alongX.begin(), alongX.end(), 0);
    std::sort(alongX.begin(), alongX.end(),
              [&](int a, int b) { return balls[at(a)].position.x < balls[at(b)].position.x; });
    double largest = 0;
    for (const Ball& ball : balls) largest = std::max(largest, ball.radius);

    std::vector<Contact> contacts;
    for (std::size_t i = 0; i < alongX.size(); ++i) {
        const Ball& ball = balls[at(alongX[i])];
        for (std::size_t j = i + 1; j < alongX.size(); ++j) {
            const Ball& other = balls[at(alongX[j])];
            if (other.position.x - ball.position.x >= ball.radius + largest) break;
            const Vector line = other.position - ball.position;
            const double reach = ball.radius + other.radius;
            if (dot(line, line) < reach * reach)
                contacts.push_back(
                    {std::min(alongX[i], alongX[j]), std::max(alongX[i], alongX[j])});
        }
    }
    std::sort(contacts.begin(), contacts.end(), [](const Contact& p, const Contact& q) {
        return p.a != q.a ? p.a < q.a : p.b < q.b;
    });
    return contacts;
}

std::vector<Contact> touchingEverything(const Balls& balls, const std::vector<Wall>& walls) {
    std::vector<Contact> contacts;
    for (int w = 0; w < static_cast<int>(walls.size()); ++w)
        for (int k = 0; k < static_cast<int>(balls.size()); ++k)
            if (geometryOf({~w, k}, balls, walls).penetration > 0) contacts.push_back({~w, k});
    const std::vector<Contact> pairs = touchingBalls(balls);
    contacts.insert(contacts.end(), pairs.begin(), pairs.end());
    return contacts;
}

Geometry geometryOf(const Contact& contact, const Balls& balls, const std::vector<Wall>& walls) {
    const Ball& b = balls[at(contact.b)];
    if (contact.a < 0) {
        const Wall& wall = walls[at(~contact.a)];
        return {wall.normal, b.radius - (dot(wall.normal, b.position) - wall.offset)};
    }
    const Ball& a = balls[at(contact.a)];
    const Vector line = b.position - a.position;
    const double distance = length(line);
    const Vector normal = distance > 0 ? (1 / distance) * line : Vector{0, 1, 0};
    return {normal, a.radius + b.radius - distance};
}

double restitutionOf(const Contact& contact, const Balls& balls) {
    const Ball& b = balls[at(contact.b)];
    return contact.a < 0 ? b.restitution : combinedRestitution(balls[at(contact.a)], b);
}

double inverseMassSum(const Contact& contact, const Balls& balls) {
    const double ofB = 1 / balls[at(contact.b)].mass;
    return contact.a < 0 ? ofB : 1 / balls[at(contact.a)].mass + ofB;
}

double separationSpeed(const Contact& contact, const Balls& balls, Vector normal) {
    const Vector ofB = balls[at(contact.b)].velocity;
    return dot(contact.a < 0 ? ofB : ofB - balls[at(contact.a)].velocity, normal);
}

void applyImpulse(const Contact& contact, Balls& balls, Vector impulse) {
    Ball& b = balls[at(contact.b)];
    b.velocity += (1 / b.mass) * impulse;
    if (contact.a < 0) return;
    Ball& a = balls[at(contact.a)];
    a.velocity -= (1 / a.mass) * impulse;
}

void applyPush(const Contact& contact, Balls& balls, Vector push) {
    Ball& b = balls[at(contact.b)];
    b.position += (1 / b.mass) * push;
    if (contact.a < 0) return;
    Ball& a = balls[at(contact.a)];
    a.position -= (1 / a.mass) * push;
}

}  // namespace ballpit::truth
