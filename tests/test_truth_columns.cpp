// Resting contacts: convergence rates, the column law, loads, and how many pairs can touch.
#include <numbers>

#include "tests/truth_support.h"
#include "truth/accumulated.h"
#include "truth/columns.h"

using namespace ballpit::truth;

namespace {

constexpr double g = 9.81;

StepSettings onTheFloor(double dt, int passes, ContactOrder order, WallTurn turn) {
    StepSettings settings;
    settings.walls.lower.y = 0;
    settings.gravity = {0, -g, 0};
    settings.dt = dt;
    settings.passes = passes;
    settings.order = order;
    settings.wallTurn = turn;
    return settings;
}

/// The deepest overlap in a column, with the floor or between two balls, m.
double deepestInColumn(const Balls& balls) {
    double deepest = balls[0].radius - balls[0].position.y;
    for (std::size_t k = 1; k < balls.size(); ++k)
        deepest = std::max(deepest,
                           2 * balls[0].radius - (balls[k].position.y - balls[k - 1].position.y));
    return deepest;
}

/// Averaged over time, once the column has settled.
double meanOverlap(int count, const StepSettings& settings) {
    GaussSeidel scheme(column(count, 1, 0), settings);
    scheme.run(2500);
    double sum = 0;
    constexpr int steps = 1500;
    for (int k = 0; k < steps; ++k) {
        scheme.step();
        sum += deepestInColumn(scheme.balls()) / steps;
    }
    return sum;
}

/// The largest speed left in a touching column, kicked down with 1 m/s, after `passes` passes. The
/// step is so short that nothing moves.
double speedLeft(Balls balls, int passes, ContactOrder order) {
    for (std::size_t k = 0; k < balls.size(); ++k)
        balls[k].position.y -= 1e-6 * static_cast<double>(k + 1);
    StepSettings settings = onTheFloor(1e-12, passes, order, WallTurn::everyPass);
    settings.gravity.y = -1 / settings.dt;
    settings.projection = 0;
    GaussSeidel scheme(balls, settings);
    scheme.step();
    double largest = 0;
    for (const Ball& ball : scheme.balls()) largest = std::max(largest, std::abs(ball.velocity.y));
    return largest;
}

}  // namespace

TEST_CASE("truth: a Gauss-Seidel pass shrinks a column's error by cos^2(pi / 2n)") {
    for (const int count : {2, 5, 10})
        for (const ContactOrder order : {ContactOrder::rising, ContactOrder::falling}) {
            CAPTURE(count);
            const int passes = count * count * 4;
            const Balls balls = column(count, 1, 0);
            CHECK(speedLeft(balls, passes + 1, order) / speedLeft(balls, passes, order) ==
                  within(columnRate(count), 1e-6));
        }
    // An e-fold takes 0.405 n^2 passes.
    CHECK(passesPerDecade(columnRate(40)) / std::log(10.0) == withinShare(0.405 * 1600, 0.01));
}

TEST_CASE("truth: under a ball of R times its mass, a pass shrinks the error by R / (1 + R)") {
    for (const double ratio : {0.1, 1.0, 10.0, 100.0}) {
        CAPTURE(ratio);
        Balls balls = column(2, 1, 0);
        balls[1].mass = ratio;
        const double rate =
            speedLeft(balls, 11, ContactOrder::rising) / speedLeft(balls, 10, ContactOrder::rising);
        CHECK(rate == within(heavyOnLightRate(ratio), 1e-6));
    }
    CHECK(passesPerDecade(heavyOnLightRate(100)) == withinShare(230, 0.01));
}

TEST_CASE("truth: with nothing remembered, a column is pressed together by about n^3 g tau^2") {
    struct Case {
        ContactOrder order;
        double constant;
    };
    const Case cases[] = {{ContactOrder::rising, columnFromBelow},
                          {ContactOrder::falling, columnFromAbove},
                          {ContactOrder::random, columnShuffled}};
    for (const auto& [order, constant] : cases) {
        CAPTURE(constant);
        const auto overlap = [&, order = order](int count, double dt, int passes) {
            return meanOverlap(count, onTheFloor(dt, passes, order, WallTurn::everyPass));
        };
        const double ten = overlap(10, 1.0 / 240, 2), twenty = overlap(20, 1.0 / 240, 2);
        const double forty = overlap(40, 1.0 / 960, 2), often = overlap(20, 1.0 / 240, 4);
        CHECK(ten == withinShare(columnOverlap(constant, 10, g, 1.0 / 480), 0.3));
        CHECK(twenty == withinShare(columnOverlap(constant, 20, g, 1.0 / 480), 0.3));
        CHECK(forty == withinShare(columnOverlap(constant, 40, g, 1.0 / 1920), 0.3));
        const double inBalls = std::log(forty * 16 / ten) / std::log(4.0);
        CHECK(inBalls == within(3, 0.5));
        const double inTime = std::log(twenty / often) / std::log(2.0);
        CHECK(inTime == within(2, 0.15));
    }
    CHECK(columnOverlap(0.6, 10, g, 0.01) == withinShare(0.6 * 1000 * g * 1e-4, 1e-12));
    CHECK(tallestColumn(0.6, columnOverlap(0.6, 10, g, 0.01), g, 0.01) == withinShare(10, 1e-12));
}

TEST_CASE("truth: a floor that acts once a step leaves n (n - 1) g dt^2, however many passes") {
    const double dt = 1.0 / 240;
    for (const int count : {2, 5, 8}) {
        CAPTURE(count);
        const StepSettings settings =
            onTheFloor(dt, 20 * count * count, ContactOrder::rising, WallTurn::oncePerStep);
        GaussSeidel scheme(column(count, 1, 0), settings);
        scheme.run(300);
        CHECK(deepestInColumn(scheme.balls()) ==
              withinShare(columnOverlapFloorOnce(count, g, dt), 0.01));
    }
}

TEST_CASE("truth: a warm-started column stands, and each contact carries what lies on it") {
    constexpr int count = 20;
    const double r = 0.1, slop = 0.01 * r;
    StepSettings settings = onTheFloor(1.0 / 60, 4, ContactOrder::rising, WallTurn::everyPass);
    settings.projection = 0.2;
    Accumulated warm(column(count, r, 0), settings, slop);
    warm.run(3000);
    CHECK(deepestInColumn(warm.balls()) < 2 * slop);
    const int floorContact = ~2;
    CHECK(warm.impulseOf(floorContact, 0) == withinShare(columnLoad(count, 1, g, 1.0 / 60), 0.01));
    for (int k = 1; k < count; ++k)
        CHECK(warm.impulseOf(k - 1, k) == withinShare(columnLoad(count - k, 1, g, 1.0 / 60), 0.01));

    Accumulated cold(column(count, r, 0), settings, slop, false);
    cold.run(3000);
    CHECK(deepestInColumn(cold.balls()) > r);
}

TEST_CASE("truth: no ball of the densest packing touches more than 12 others") {
    Balls balls;
    for (int z = 0; z < 10; ++z)
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 10; ++x)
                if ((x + y + z) % 2 == 0)
                    balls.push_back({{1.0 * x, 1.0 * y, 1.0 * z}, {}, std::sqrt(0.5) + 1e-9});
    std::vector<int> touching(balls.size(), 0);
    const std::vector<Contact> contacts = touchingBalls(balls);
    for (const Contact& contact : contacts)
        for (const int k : {contact.a, contact.b}) ++touching[static_cast<std::size_t>(k)];
    CHECK(*std::max_element(touching.begin(), touching.end()) == 12);
    const auto count = static_cast<double>(balls.size()),
               pairs = static_cast<double>(contacts.size());
    CHECK(pairs <= mostPairsOfEqualBalls(count));
    CHECK(pairs > 0.8 * mostPairsOfEqualBalls(count));
    CHECK(mostPairsOfAnyBalls(count) == 2 * mostPairsOfEqualBalls(count));
}
