// Bodies as the checks of chapter 04 see them: one record each, dealt like cards, so that the
// oracle shares neither the arrays nor the loops of the piece. And the classic mistakes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "04_reorder/reorder.cuh"
#include "common/random.h"
#include "tests/checks/check.cuh"

namespace ballpit::check {

using Bits = std::array<std::uint32_t, 4>;

/// One body in one record.
struct Body {
    Vec4 position, velocity;
    float restitution;
    std::uint32_t id;
};
using Bodies = std::vector<Body>;
using Order = std::vector<std::uint32_t>;  ///< for each slot, the slot that its body comes from

/// To the last bit: -0 is not 0 here.
inline bool same(Vec4 a, Vec4 b) { return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b); }
inline bool same(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
inline bool operator==(const Body& a, const Body& b) {
    return same(a.position, b.position) && same(a.velocity, b.velocity) &&
           same(a.restitution, b.restitution) && a.id == b.id;
}

inline std::string inWords(Vec4 v, const char* w) {
    return text(xyz(v)) + " " + w + " " + text(v.w);
}

/// What the arrays hold before anything is written: values of no body.
const Body stale{{-99, -99, -99, -99}, {-88, -88, -88, -88}, -77, 4000000000u};

/// The arrays of bodies on a device.
class Arrays {
public:
    Arrays(Device device, std::size_t count)
        : positions_(device, count, "positions"),
          velocities_(device, count, "velocities"),
          restitutions_(device, count, "restitutions"),
          ids_(device, count, "ids") {
        upload(Bodies(count, stale));
    }
    Arrays(Device device, const Bodies& bodies) : Arrays(device, bodies.size()) { upload(bodies); }

    void upload(const Bodies& bodies) {
        std::vector<Vec4> positions, velocities;
        std::vector<float> restitutions;
        std::vector<std::uint32_t> ids;
        for (const Body& body : bodies) {
            positions.push_back(body.position);
            velocities.push_back(body.velocity);
            restitutions.push_back(body.restitution);
            ids.push_back(body.id);
        }
        positions_.upload(positions);
        velocities_.upload(velocities);
        restitutions_.upload(restitutions);
        ids_.upload(ids);
    }
    Bodies download() const {
        const auto positions = positions_.download(), velocities = velocities_.download();
        const auto restitutions = restitutions_.download();
        const auto ids = ids_.download();
        Bodies bodies;
        for (std::size_t k = 0; k < ids.size(); ++k)
            bodies.push_back({positions[k], velocities[k], restitutions[k], ids[k]});
        return bodies;
    }
    BodiesView view() {
        return {positions_.view(), velocities_.view(), restitutions_.view(), ids_.view()};
    }

private:
    DeviceBuffer<Vec4> positions_, velocities_;
    DeviceBuffer<float> restitutions_;
    DeviceBuffer<std::uint32_t> ids_;
};

inline void gather(Device device, const Order& order, Arrays& from, Arrays& to) {
    auto indices = uploaded(device, order, "sortedIndices");
    launch<reorderData>(device, static_cast<int>(order.size()),
                        View<const std::uint32_t>(indices.view()), from.view(), to.view());
}

inline Bodies gathered(Device device, const Order& order, const Bodies& bodies) {
    Arrays from(device, bodies), to(device, bodies.size());
    gather(device, order, from, to);
    return to.download();
}

/// Takes the bodies off one pile and puts them onto another, in the order of the slots.
inline Bodies dealt(const Order& order, const Bodies& bodies) {
    Bodies pile;
    for (const std::uint32_t slot : order) pile.push_back(bodies.at(slot));
    return pile;
}

// The classic mistakes, for the guess.

inline bool isScattered(const Order& order, const Bodies& bodies, const Bodies& got) {
    for (std::size_t k = 0; k < order.size(); ++k)
        if (!same(got[order[k]].position, bodies[k].position)) return false;
    return true;
}
/// As a loop from the first slot on would leave it.
inline bool isInPlace(const Order& order, const Bodies& bodies, const Bodies& got) {
    Bodies mistaken = bodies;
    for (std::size_t k = 0; k < order.size(); ++k) mistaken[k] = mistaken[order[k]];
    const auto match = [](const Body& a, const Body& b) { return same(a.position, b.position); };
    return std::equal(got.begin(), got.end(), mistaken.begin(), match);
}
template <class Test>
bool everywhere(const Order& order, const Bodies& got, Test test) {
    for (std::size_t k = 0; k < order.size(); ++k)
        if (!test(got[k], order[k])) return false;
    return !order.empty();
}
template <class Test>
bool anywhere(const Bodies& got, Test test) {
    return std::any_of(got.begin(), got.end(), test);
}

inline void guessMistake(Report& report, const Order& order, const Bodies& bodies,
                         const Bodies& got) {
    const Bodies expected = dealt(order, bodies);
    bool placesWrong = false, idsWrong = false;
    for (std::size_t k = 0; k < got.size(); ++k) {
        placesWrong = placesWrong || !same(got[k].position, expected[k].position);
        idsWrong = idsWrong || got[k].id != expected[k].id;
    }
    report.guess(
        {{"a scatter for a gather: slot i was sent to slot sortedIndices[i], but it must get the "
          "body that lies there",
          [&] { return placesWrong && isScattered(order, bodies, got); }},
         {"a field that is never written: the array holds what was in it before",
          [&] {
              return anywhere(got, [](const Body& b) {
                  return same(b.velocity, stale.velocity) || same(b.position, stale.position) ||
                         same(b.restitution, stale.restitution) || b.id == stale.id;
              });
          }},
         {"slot numbers in place of ids: that is right only while body k lies in slot k",
          [&] {
              return idsWrong && everywhere(order, got, [](const Body& b, std::uint32_t slot) {
                         return b.id == slot;
                     });
          }},
         {"the ids stay where they are, and the bodies go: nobody can tell any more who is who",
          [&] {
              for (std::size_t k = 0; k < got.size(); ++k)
                  if (got[k].id != bodies[k].id) return false;
              return idsWrong;
          }},
         {"sorting in place: a body was read after another thread had overwritten it",
          [&] { return placesWrong && isInPlace(order, bodies, got); }},
         {"x, y, z are carried and w is lost: the radius travels with the position, 1 / mass with "
          "the velocity",
          [&] {
              return everywhere(order, got, [&](const Body& b, std::uint32_t slot) {
                  return xyz(b.position) == xyz(bodies[slot].position) &&
                         xyz(b.velocity) == xyz(bodies[slot].velocity) &&
                         (!same(b.position.w, bodies[slot].position.w) ||
                          !same(b.velocity.w, bodies[slot].velocity.w));
              });
          }}});
}

inline bool requireSame(Report& report, const Bodies& got, const Bodies& expected) {
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const Body &g = got[k], &e = expected[k];
        const std::string slot = " in slot " + text(k);
        if (g.id != e.id) report.fail("id" + slot, text(g.id), text(e.id));
        if (!same(g.position, e.position))
            report.fail("position" + slot, inWords(g.position, "radius"),
                        inWords(e.position, "radius"));
        if (!same(g.velocity, e.velocity))
            report.fail("velocity" + slot, inWords(g.velocity, "1/mass"),
                        inWords(e.velocity, "1/mass"));
        if (!same(g.restitution, e.restitution))
            report.fail("restitution" + slot, text(g.restitution), text(e.restitution));
    }
    return !report.failed();
}

inline void requireRightOrder(Report& report, const Order& order, const Bodies& bodies) {
    const Bodies got = gathered(report.device, order, bodies);
    if (!requireSame(report, got, dealt(order, bodies))) guessMistake(report, order, bodies, got);
}

inline Bodies randomBodies(int count, Bounds box, std::uint64_t seed) {
    Random random(seed);
    Bodies bodies;
    for (int k = 0; k < count; ++k)
        bodies.push_back({withW(random.uniformIn(box), random.uniform(0.1f, 0.5f)),
                          withW(random.uniformIn({{-4, -4, -4}, {4, 4, 4}}), random.uniform(1, 9)),
                          random.uniform(0, 1), static_cast<std::uint32_t>(k)});
    return bodies;
}

inline Order randomOrder(int count, std::uint64_t seed) {
    Order order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), 0u);
    Random random(seed);
    for (std::size_t k = order.size(); k > 1; --k)
        std::swap(order[k - 1], order[random.next() % k]);
    return order;
}

}  // namespace ballpit::check
