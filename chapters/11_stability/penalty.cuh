// Chapter 11: springs and dashpots. Balls may overlap, and are pressed apart by a force,
//     F = m_eff (K d - C v_n),    K = (pi^2 + ln^2 e) / t_c^2,    C = -2 ln e / t_c,
// with d the penetration in m, v_n the speed of separation in m/s and m_eff = 1 / (1/m_a + 1/m_b):
// every contact of two bodies then takes the same time t_c and ends with e times the speed. (The
// dashpot pulls at the end of a contact; that is part of the formula for e.) Walls are the same,
// with m_eff the body's mass. Each body adds up its contacts in a fixed order.
//
// The step must resolve the contact: t_c is 20 substeps, and more substeps make harder balls. Where
// it fails: a ball of speed v sinks in by v t_c / pi, so a fast one passes through; and e is met to
// some hundredths only, since a contact begins and ends within a substep. e = 0 would need a
// dashpot without end, and is refused.
#pragma once

#include "07_impulse_response/contact_lists.cuh"
#include "07_impulse_response/impulse_response.cuh"
#include "11_stability/reach.cuh"
#include "common/hole.cuh"

namespace ballpit {

struct PenaltySettings {
    float h;            ///< s: a substep
    float contactTime;  ///< s: t_c
    Bounds walls;       ///< m
};

constexpr float substepsOfContact = 20.0f;
/// Below this the dashpot is too stiff for the substep.
constexpr float leastPenaltyRestitution = 0.01f;

/// ln x for normal x > 0, with + - * / alone, so that every machine gets the same bits:
/// x = 2^n y, y near 1, ln y = 2 artanh((y - 1) / (y + 1)). Right to about 1e-6 of itself.
HD inline float naturalLogarithm(float x) {
    float power = 0.0f;
    while (x > 1.41421356f) x *= 0.5f, power += 1.0f;
    while (x < 0.70710678f) x *= 2.0f, power -= 1.0f;
    const float t = (x - 1.0f) / (x + 1.0f), t2 = t * t;
    const float series =
        1.0f + t2 * (1.0f / 3 + t2 * (1.0f / 5 + t2 * (1.0f / 7 + t2 * (1.0f / 9))));
    return power * 0.69314718f + 2.0f * t * series;
}

/// What a contact adds to the relative velocity of its bodies in a substep, m/s along the normal.
HD inline float pressure(float penetration, float separation, float restitution,
                         const PenaltySettings& s) {
    constexpr float piSquared = 9.8696044f;
    const float logarithm = naturalLogarithm(restitution);
    // ---- hole spring.force (about 3 lines): K and C from the contact's time and e; then what they do in h
    TODO_HOLE("spring.force");
    return 0.0f * piSquared * logarithm;
    // ---- end of spring.force
}

/// Along one axis: what the walls add to a body's velocity.
HD inline float pressureOfWalls(float place, float velocity, float lower, float upper,
                                float restitution, const PenaltySettings& s) {
    if (place < lower) return pressure(lower - place, velocity, restitution, s);
    if (place > upper) return -pressure(place - upper, -velocity, restitution, s);
    return 0.0f;
}

HD inline void emptyString(int i, ContactsView contacts) { contacts.firstIncoming[i] = noPair; }
HD inline void linkPairs(int thread, ContactsView contacts) {
    visitPairsOfThread(thread, contacts.pairs, [&](std::uint32_t k) { linkIncoming(k, contacts); });
}
HD inline void sortString(int i, ContactsView contacts) { sortIncoming(i, contacts); }

/// Body i: adds up what presses on it.
HD inline void pressApart(int i, ResponseRound round, ContactsView contacts,
                          PenaltySettings settings) {
    const BodiesView& bodies = round.from;
    const Vec4 sphere = bodies.positions[i], moving = bodies.velocities[i];
    Vec3 velocityChange;
    visitContacts(i, contacts, [&](std::uint32_t k, float sign) {
        const auto [a, b] = contacts.pairs.pairs[k];
        if (!spheresTouch(bodies.positions[a], bodies.positions[b])) return;
        const Contact contact = contactBetween(a, b, bodies);
        const float change =
            pressure(contact.penetration, contact.separation,
                     combinedRestitution(bodies.restitutions[a], bodies.restitutions[b]), settings);
        const float share = moving.w / (bodies.velocities[a].w + bodies.velocities[b].w);
        velocityChange += (sign * share * change) * contact.normal;
    });
    const Bounds& walls = settings.walls;
    const float r = sphere.w, e = bodies.restitutions[i];
    velocityChange.x +=
        pressureOfWalls(sphere.x, moving.x, walls.lower.x + r, walls.upper.x - r, e, settings);
    velocityChange.y +=
        pressureOfWalls(sphere.y, moving.y, walls.lower.y + r, walls.upper.y - r, e, settings);
    velocityChange.z +=
        pressureOfWalls(sphere.z, moving.z, walls.lower.z + r, walls.upper.z - r, e, settings);
    const Vec3 velocity = xyz(moving) + velocityChange;
    round.to.positions[i] = sphere;
    round.to.velocities[i] = withW(velocity, moving.w);
    reportMotion(i, round, {}, xyz(sphere), velocity);
}

class PenaltyResponse : public Response {
public:
    PenaltyResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity, float h,
                    Bounds walls)
        : device_(device),
          settings_{h, substepsOfContact * h, walls},
          lists_(device, bodyCount, pairCapacity) {}

    StepKind stepKind() const override { return StepKind::substeps; }
    float leastRestitution() const override { return leastPenaltyRestitution; }

    void resolve(const ResponseRound& round) override {
        const ContactsView contacts = lists_.view(round.pairs);
        if (round.newPairs) {
            launch<emptyString>(device_, round.bodyCount, contacts);
            launch<linkPairs>(device_, round.bodyCount, contacts);
            launch<sortString>(device_, round.bodyCount, contacts);
        }
        launch<pressApart>(device_, round.bodyCount, round, contacts, settings_);
    }
    void reserve(std::size_t pairCapacity) override { lists_.reserve(pairCapacity); }
    std::size_t bytes() const override { return lists_.bytes(); }

private:
    Device device_;
    PenaltySettings settings_;
    ContactLists lists_;
};

}  // namespace ballpit
