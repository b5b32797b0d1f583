// Chapter 11: one pair after the other, in place, as a single thread would do it (Gauss-Seidel):
// each pair sees what the pairs before it have done. Pairs of one colour share no body, so all
// of them can be resolved at the same time; colour follows colour.
//
// Each single resolution conserves momentum, and energy where e = 1; so does the whole, at any
// density and any step. Where it fails: a deep pile. A round carries a push from floor to top one
// contact a colour, and forgets it at the end: the overlap in a column of n balls grows like n^3.
#pragma once

#include "07_impulse_response/racy_response.cuh"
#include "11_stability/colouring.cuh"
#include "11_stability/contact_rules.cuh"

namespace ballpit {

/// Pair k, in place. Racy, but for the colours.
HD inline void resolvePair(std::uint32_t k, const ResponseRound& round, ContactRules rules) {
    const BodiesView& bodies = round.to;
    const auto [a, b] = round.pairs.pairs[k];
    const NormalEffect effect = effectUnder(rules, a, b, bodies);
    const auto change = [&](std::uint32_t body, float sign) {
        const float inverseMass = bodies.velocities[body].w;
        const auto moved = [&](Vec4 before, float amount) {
            return withW(xyz(before) + (sign * amount * inverseMass) * effect.normal, before.w);
        };
        bodies.velocities[body] = moved(bodies.velocities[body], effect.impulse);
        bodies.positions[body] = moved(bodies.positions[body], effect.push);
    };
    change(a, -1.0f);
    change(b, 1.0f);
}

class ColouredResponse : public Response {
public:
    ColouredResponse(Device device, std::size_t bodyCount, std::size_t pairCapacity,
                     const ContactRules& rules)
        : device_(device), rules_(rules), colouring_(device, bodyCount, pairCapacity) {}

    void resolve(const ResponseRound& round) override { resolveWith<resolvePair>(round); }
    void reserve(std::size_t pairCapacity) override { colouring_.reserve(pairCapacity); }
    std::size_t bytes() const override { return colouring_.bytes(); }

protected:
    /// Runs body(k, round, rules, arguments...) for every pair k, colour after colour.
    template <auto body, class... Args>
    void resolveWith(const ResponseRound& round, Args... args) {
        launch<copyBody>(device_, round.bodyCount, round.from, round.to);
        colouring_.colour(round.pairs);
        colouring_.forEachPair<body>(round, rules_, args...);
        launch<reportRound>(device_, round.bodyCount, round);
    }

private:
    Device device_;
    ContactRules rules_;
    Colouring colouring_;
};

}  // namespace ballpit
