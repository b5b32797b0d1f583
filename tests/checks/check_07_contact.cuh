// Chapter 07's checks whose answers were worked out by hand: motion, walls, one contact.
#pragma once

#include "07_impulse_response/integrate.cuh"
#include "tests/checks/check_07_oracle.cuh"

namespace ballpit::check {

constexpr Bounds farWalls{{-1000, -1000, -1000}, {1000, 1000, 1000}};

inline Spheres moved(Device device, Spheres balls, const MotionSettings& motion, int steps) {
    for (int k = 0; k < steps; ++k) {
        OneRound bodies(device, balls, {});
        const ResponseRound round = bodies.round();
        launch<integrate>(device, round.bodyCount, round.from, round.to, motion, round.status);
        balls = bodies.result();
    }
    return balls;
}

inline void oneStep(Report& report) {
    Spheres ball;
    ball.add({1, 2, 3}, {2, 0, -1}, 0.5f, 4, 1);
    const MotionSettings motion{{0, -10, 0}, 0.5f, 0.1f, farWalls};
    const Spheres after = moved(report.device, ball, motion, 1);
    requireNear(report, "velocity after g dt = (0, -1, 0) and 5 % damping", after.velocities[0],
                {1.9f, -0.95f, -0.95f});
    requireNear(report, "position after moving on for 0.1 s with that velocity", after.positions[0],
                {1.19f, 1.905f, 2.905f});
    const auto isAt = [&](Vec3 place) { return length(after.positions[0] - place) < 1e-5f; };
    report.guess({{"explicit Euler: the position moved with the velocity from before",
                   [&] {
                       return isAt({1.2f, 2, 2.9f});
                   }},
                  {"the position moved before the damping was applied",
                   [&] {
                       return isAt({1.2f, 1.9f, 2.9f});
                   }},
                  {"damping was forgotten", [&] {
                       return length(after.velocities[0] - Vec3{2, -1, -1}) < 1e-5f;
                   }}});
}

inline void freeFall(Report& report) {
    constexpr double g = 9.81, dt = 1.0 / 60, start = 100, speed = 3;
    Spheres ball;
    ball.add({0, float(start), 0}, {0, float(speed), 0}, 0.5f, 1, 1);
    const MotionSettings motion{{0, -float(g), 0}, 0, float(dt), farWalls};
    const int n = 120;
    const double height = moved(report.device, ball, motion, n).positions[0].y;
    // Each step adds its own new velocity: 1 + 2 + ... + n times g dt.
    const double here = start + n * speed * dt - g * dt * dt * n * (n + 1) / 2;
    requireNear(report, "height after 120 steps, m", height, here, 1e-3);
    report.guess({{"explicit Euler: the position moved with the velocity from before",
                   [&] { return std::abs(height - here - g * dt * dt * n) < 1e-3; }}});
}

inline void walls(Report& report) {
    struct Row {
        float position, velocity, positionAfter, velocityAfter;
        const char* what;
    };
    for (const Row& row :
         {Row{2, -3, 2, -3, "inside"}, Row{1, -3, 1, -3, "exactly on the lower wall"},
          Row{0.5f, -3, 1, 1.5f, "through the lower wall"},
          Row{0.5f, 3, 1, 3, "beyond the lower wall, but coming back"},
          Row{9.5f, 3, 9, -1.5f, "through the upper wall"},
          Row{9.5f, -3, 9, -3, "beyond the upper wall, but coming back"},
          Row{-50, 0, 1, 0, "at rest, far outside"}}) {
        float position = row.position, velocity = row.velocity;
        bounceOffWalls(position, velocity, 1, 9, 0.5f);
        requireNear(report, std::string("position of a ball ") + row.what, position,
                    row.positionAfter);
        requireNear(report, std::string("velocity of a ball ") + row.what, velocity,
                    row.velocityAfter);
    }
    report.guess(
        {{"the velocity is turned without a look at its sign: a ball that is coming back "
          "is sent out again",
          [] {
              float position = 0.5f, velocity = 3;
              bounceOffWalls(position, velocity, 1, 9, 0.5f);
              return velocity < 0;
          }}});
}

// ---- one contact

/// Two balls of radius 0.5 m with these centres and velocities, and what kernels see of them.
struct TwoBalls {
    TwoBalls(Vec3 a, Vec3 b, Vec3 velocityA = {}, Vec3 velocityB = {}, float massB = 1,
             float restitutionB = 1)
        : bodies(Device::cpu, both(a, b, velocityA, velocityB, massB, restitutionB), {}) {}

    BodiesView view() { return bodies.round().from; }
    OneRound bodies;

private:
    static Spheres both(Vec3 a, Vec3 b, Vec3 velocityA, Vec3 velocityB, float massB,
                        float restitutionB) {
        Spheres balls;
        balls.add(a, velocityA, 0.5f, 1, 1);
        balls.add(b, velocityB, 0.5f, massB, restitutionB);
        return balls;
    }
};

inline void line(Report& report) {
    TwoBalls apart({1, 2, 3}, {1.5f, 1, 3.25f});
    requireNear(report, "line from ball 0 to ball 1", lineOfCentres(0, 1, apart.view()),
                {0.5f, -1, 0.25f});
    requireNear(report, "line from ball 1 to ball 0", lineOfCentres(1, 0, apart.view()),
                {-0.5f, 1, -0.25f});
    // One centre; then so near that the square of the distance is 0. Slots are where a ball lies
    // now, ids are its own: here they run alike, then against each other.
    auto idsAgainst = uploaded(Device::cpu, std::vector<std::uint32_t>{7, 3}, "ids");
    const auto lineBetween = [&](std::uint32_t a, std::uint32_t b, float apart, bool against) {
        TwoBalls balls({0, 0, 0}, {apart, 0, 0});
        BodiesView view = balls.view();
        if (against) view.ids = idsAgainst.view();
        return lineOfCentres(a, b, view);
    };
    for (const bool against : {false, true})
        for (const float apart : {0.0f, 1e-30f}) {
            const std::string where = std::string(apart > 0 ? ", 1e-30 m apart" : ", one centre") +
                                      (against ? ", ids 7 and 3" : ", ids 0 and 1");
            const Vec3 up{0, against ? -1.0f : 1.0f, 0};
            requireNear(report, "line from slot 0 to slot 1" + where,
                        lineBetween(0, 1, apart, against), up);
            requireNear(report, "line from slot 1 to slot 0" + where,
                        lineBetween(1, 0, apart, against), -1.0f * up);
        }
    report.guess(
        {{"no answer for coincident centres: their line is 0, and dividing by its length "
          "gives NaN",
          [&] { return length(lineBetween(0, 1, 0, false)) == 0; }},
         {"the line was compared with 0, not its squared length: the square of 1e-30 is 0 as well",
          [&] { return length(lineBetween(0, 1, 1e-30f, false)) == 0; }},
         {"the slots were compared: ids stay with a ball, slots change when the balls are sorted",
          [&] { return lineBetween(0, 1, 0, true).y > 0 && lineBetween(1, 0, 0, true).y < 0; }}});
}

inline void contact(Report& report) {
    const Vec3 place{0.48f, 0.64f, 0};  // 0.8 m off
    struct Row {
        const char* what;
        Vec3 a, b;
        Contact expected;
    };
    // Ball 0 moves with (1, 0, 0), ball 1 with (0, -2, 0).
    for (const Row& row :
         {Row{"0.8 m apart", {0, 0, 0}, place, {{0.6f, 0.8f, 0}, 0.2f, -2.2f}},
          Row{"the other way", place, {0, 0, 0}, {{-0.6f, -0.8f, 0}, 0.2f, 2.2f}},
          Row{"not quite touching", {0, 0, 0}, {0, 1.5f, 0}, {{0, 1, 0}, -0.5f, -2}},
          Row{"one centre", {3, 3, 3}, {3, 3, 3}, {{0, 1, 0}, 1, -2}}}) {
        TwoBalls balls(row.a, row.b, {1, 0, 0}, {0, -2, 0});
        const Contact got = contactBetween(0, 1, balls.view());
        const std::string where = std::string(row.what) + ": ";
        requireNear(report, where + "normal", got.normal, row.expected.normal);
        requireNear(report, where + "penetration, m", got.penetration, row.expected.penetration);
        requireNear(report, where + "separation, m/s", got.separation, row.expected.separation);
    }
    TwoBalls balls({0, 0, 0}, place, {1, 0, 0}, {0, -2, 0}), one({3, 3, 3}, {3, 3, 3});
    const Contact got = contactBetween(0, 1, balls.view());
    report.guess(
        {{"the normal was not divided by the distance: it must have length 1",
          [&] { return std::abs(length(got.normal) - 0.8f) < 1e-5f; }},
         {"the normal points from the second ball to the first",
          [&] {
              return length(got.normal + Vec3{0.6f, 0.8f, 0}) < 1e-5f;
          }},
         {"the speed along the line was not divided by its length",
          [&] { return std::abs(got.separation + 2.2f * 0.8f) < 1e-5f; }},
         {"the length of the substitute line was taken for the distance of coincident centres",
          [&] { return std::abs(contactBetween(0, 1, one.view()).penetration) < 1e-5f; }}});
}

inline void alongNormal(Report& report) {
    struct Row {
        float separation, restitution, inverseMassSum, impulse;
        const char* what;
    };
    for (const Row& row :
         {Row{-2, 1, 2, 2, "1 kg and 1 kg, elastic"}, Row{-2, 0, 2, 1, "1 kg and 1 kg, no bounce"},
          Row{-2.4f, 0.5f, 1.5f, 2.4f, "the lesson's two balls"},
          Row{-4, 0.5f, 0.5f, 12, "4 kg and 4 kg"},
          Row{-3, 1, 1.25f, 4.8f, "1 kg and 4 kg, elastic"}})
        requireNear(report, std::string("impulse of ") + row.what + ", N s",
                    impulseAlongNormal(row.separation, row.restitution, row.inverseMassSum),
                    row.impulse);
    const float got = impulseAlongNormal(-4, 0.5f, 0.5f);
    report.guess({{"the sign: an approach (v_n < 0) must give an impulse that pushes apart (J > 0)",
                   [&] { return std::abs(got + 12) < 1e-4f; }},
                  {"1 - e in place of 1 + e", [&] { return std::abs(got - 4) < 1e-4f; }},
                  {"multiplied by the inverse masses in place of divided by them",
                   [&] { return std::abs(got - 3) < 1e-4f; }}});
}

inline void push(Report& report) {
    requireNear(report, "push of two balls of 1 kg, 0.1 m deep", pushAlongNormal(0.1f, 2), 0.05);
    requireNear(report, "push of the lesson's two balls", pushAlongNormal(0.05f, 1.5f), 0.05 / 1.5);
    requireNear(report, "push of 4 kg and 4 kg, 0.1 m deep", pushAlongNormal(0.1f, 0.5f), 0.2);
    requireNear(report, "push of balls that just touch", pushAlongNormal(0, 2), 0);
    const auto isPush = [](double push) {
        return std::abs(pushAlongNormal(0.05f, 1.5f) - push) < 1e-5;
    };
    report.guess({{"half the overlap for each ball: the lighter one must give way more",
                   [&] { return isPush(0.025); }},
                  {"half the push for each ball: both get all of it, and each divides by its mass",
                   [&] { return isPush(0.025 / 1.5); }},
                  {"multiplied by the inverse masses in place of divided by them",
                   [&] { return isPush(0.05 * 1.5); }}});
}

inline void pair(Report& report) {
    struct Row {
        const char* what;
        Vec3 velocityA, velocityB;
        Vec3 impulse;
    };
    // 1 kg (e = 1) and 2 kg (e = 0.5), 0.95 m apart along (0.8, 0.6, 0).
    for (const Row& row : {Row{"the lesson's example", {3, 0, 0}, {0, 0, 0}, {1.92f, 1.44f, 0}},
                           Row{"side by side", {1, 1, 1}, {1, 1, 1}, {0, 0, 0}},
                           Row{"leaving each other", {-3, 0, 0}, {0, 0, 0}, {0, 0, 0}},
                           Row{"sliding past", {-0.6f, 0.8f, 0}, {0, 0, 5}, {0, 0, 0}}}) {
        TwoBalls balls({0, 0, 0}, {0.76f, 0.57f, 0}, row.velocityA, row.velocityB, 2, 0.5f);
        const PairEffect got = effectOfPair(0, 1, balls.view());
        const std::string where = std::string(row.what) + ": ";
        requireNear(report, where + "impulse, N s", got.impulse, row.impulse);
        requireNear(report, where + "push, kg m", got.push, (0.05f / 1.5f) * Vec3{0.8f, 0.6f, 0});
    }
    TwoBalls leaving({0, 0, 0}, {0.76f, 0.57f, 0}, {-3, 0, 0}, {0, 0, 0}, 2, 0.5f);
    TwoBalls meeting({0, 0, 0}, {0.76f, 0.57f, 0}, {3, 0, 0}, {0, 0, 0}, 2, 0.5f);
    report.guess({{"balls that leave each other get an impulse as well, and are pulled back",
                   [&] { return length(effectOfPair(0, 1, leaving.view()).impulse) > 1; }},
                  {"the bouncier of the two balls decides; it is the duller one", [&] {
                       return std::abs(length(effectOfPair(0, 1, meeting.view()).impulse) - 3.2f) <
                              1e-4f;
                   }}});
}

}  // namespace ballpit::check
