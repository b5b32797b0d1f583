// The sequential reference step: what it keeps, what it does in detail, and its search for
// contacts.
#include <numbers>

#include "common/random.h"
#include "tests/truth_support.h"
#include "truth/gas.h"
#include "truth/gauss_seidel.h"

using namespace ballpit::truth;

namespace {

/// An elastic or inelastic gas in a box with walls, at the share of volume phi.
Gas walledGas(double phi, double restitution) {
    const double density = phi * 6 / std::numbers::pi;
    return latticeGas(
        {.cellsPerSide = 4, .density = density, .restitution = restitution, .seed = 3}, true);
}

/// Steps until each ball has had `each` collisions; s = v_rms dt / r.
GaussSeidel collided(const Gas& gas, double s, int each, ContactOrder order) {
    const double dt = s * 0.5 / std::sqrt(3.0);  // v_rms = sqrt(3 T / m), r = 0.5
    GaussSeidel scheme(gas.balls, {.walls = gas.box, .dt = dt, .order = order});
    const std::uint64_t wanted = gas.balls.size() * static_cast<std::uint64_t>(each) / 2;
    while (scheme.counts().impulses < wanted) scheme.step();
    return scheme;
}

}  // namespace

TEST_CASE(
    "truth: one pair after the other keeps an elastic gas's energy to rounding, dilute or dense") {
    for (const double phi : {0.1, 0.4})
        for (const double s : {0.1, 0.3})
            for (const ContactOrder order : {ContactOrder::rising, ContactOrder::random}) {
                CAPTURE(phi, s);
                const Gas gas = walledGas(phi, 1);
                GaussSeidel scheme = collided(gas, s, 50, order);
                CHECK(kineticEnergy(scheme.balls()) ==
                      withinShare(kineticEnergy(gas.balls), 1e-12));
            }
}

TEST_CASE("truth: an inelastic gas only loses energy, step by step") {
    const Gas gas = walledGas(0.4, 0.8);
    GaussSeidel scheme(gas.balls, {.walls = gas.box, .dt = 0.05});
    double energy = kineticEnergy(gas.balls);
    for (int k = 0; k < 50; ++k) {
        scheme.step();
        REQUIRE(kineticEnergy(scheme.balls()) <= energy * (1 + 1e-14));
        energy = kineticEnergy(scheme.balls());
    }
    CHECK(energy < 0.1 * kineticEnergy(gas.balls));
}

TEST_CASE("truth: without walls momentum and the centre of mass are kept, of any masses") {
    ballpit::Random random(5);
    const auto uniform = [&](float low, float high) {
        return static_cast<double>(random.uniform(low, high));
    };
    Balls balls;
    for (int k = 0; k < 60; ++k)  // a crowd that overlaps from the start
        balls.push_back({{uniform(0, 3), uniform(0, 3), uniform(0, 3)},
                         {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)},
                         uniform(0.2f, 0.6f),
                         uniform(0.1f, 10),
                         uniform(0, 1)});
    const auto centre = [](const Balls& all) {
        Vector sum;
        for (const Ball& ball : all) sum += ball.mass * ball.position;
        return sum;
    };
    const Vector before = momentum(balls), start = centre(balls);
    GaussSeidel scheme(balls, {.dt = 0.01});
    scheme.run(100);
    REQUIRE(scheme.counts().impulses > 100);
    CHECK(length(momentum(scheme.balls()) - before) < 1e-12);
    CHECK(length(centre(scheme.balls()) - start - 1.0 * before) < 1e-10);  // after 1 s
}

TEST_CASE("truth: a push shares the overlap by mass, and only as much of it as asked") {
    for (const double beta : {0.3, 1.0}) {
        const Balls balls{{{0, 0, 0}, {}, 0.5, 1, 1}, {{0.8, 0, 0}, {}, 0.5, 3, 1}};
        CHECK(deepestOverlap(balls) == within(0.2, 1e-15));
        GaussSeidel scheme(balls, {.passes = 1, .projection = beta});
        scheme.step();
        CHECK(deepestOverlap(scheme.balls()) == within(0.2 * (1 - beta), 1e-15));
        CHECK(scheme.balls()[0].position.x == within(-0.2 * beta * 0.75, 1e-15));
        CHECK(scheme.balls()[1].position.x == within(0.8 + 0.2 * beta * 0.25, 1e-15));
        CHECK(kineticEnergy(scheme.balls()) == 0);
    }
}

TEST_CASE("truth: below the restitution threshold nothing bounces, ball or wall") {
    for (const double speed : {0.1, 0.3}) {
        const bool bounces = speed > 0.2;
        StepSettings settings{.dt = 1e-6, .passes = 1, .restitutionThreshold = 0.2};
        GaussSeidel pair({{{0, 0, 0}, {speed, 0, 0}}, {{0.9999, 0, 0}, {}}}, settings);
        pair.step();
        CHECK(pair.balls()[1].velocity.x == within(bounces ? speed : speed / 2, 1e-14));
        settings.walls = {{0, 0, 0}, {9, 9, 9}};
        for (const WallTurn turn : {WallTurn::oncePerStep, WallTurn::everyPass}) {
            settings.wallTurn = turn;
            GaussSeidel wall({{{4, 8.6, 4}, {0, speed, 0}}}, settings);
            wall.step();
            CHECK(wall.balls()[0].velocity.y == within(bounces ? -speed : 0, 1e-14));
            CHECK(wall.balls()[0].position.y == within(8.5, 1e-14));
        }
    }
}

TEST_CASE("truth: a ball beyond a wall that comes back already is put back, no more") {
    StepSettings settings{.walls = {{0, 0, 0}, {9, 9, 9}}, .dt = 1e-6, .passes = 1};
    for (const WallTurn turn : {WallTurn::oncePerStep, WallTurn::everyPass}) {
        settings.wallTurn = turn;
        GaussSeidel scheme({{{0.3, 4, 8.9}, {2, 0, -1}}}, settings);
        scheme.step();
        CHECK(scheme.balls()[0].position.x == within(0.5, 1e-14));
        CHECK(scheme.balls()[0].position.z == within(8.5, 1e-14));
        CHECK(scheme.balls()[0].velocity.x == 2);
        CHECK(scheme.balls()[0].velocity.z == -1);
    }
}

TEST_CASE("truth: balls that part are left alone, and coincident ones are told apart") {
    GaussSeidel parting({{{0, 0, 0}, {-1, 0, 0}}, {{0.9, 0, 0}, {2, 0, 0}}}, {.dt = 1e-3});
    parting.step();
    CHECK(parting.counts().impulses == 0);
    CHECK(parting.balls()[1].velocity.x == 2);

    GaussSeidel coincident({{{1, 1, 1}, {}}, {{1, 1, 1}, {}}}, {.dt = 1e-3, .passes = 1});
    coincident.step();
    CHECK(coincident.balls()[1].position.y - coincident.balls()[0].position.y == within(1, 1e-15));
}

TEST_CASE("truth: the sweep finds the touching pairs that comparing every two finds") {
    ballpit::Random random(9);
    Balls balls;
    for (int k = 0; k < 300; ++k) {
        const ballpit::Vec3 p = random.uniformIn({{0, 0, 0}, {6, 6, 6}});
        balls.push_back(
            {{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)},
             {},
             static_cast<double>(random.uniform(0.05f, 0.8f))});
    }
    std::size_t next = 0;
    const std::vector<Contact> found = touchingBalls(balls);
    for (int a = 0; a < 300; ++a)
        for (int b = a + 1; b < 300; ++b) {
            const Ball &p = balls[static_cast<std::size_t>(a)],
                       &q = balls[static_cast<std::size_t>(b)];
            if (length(p.position - q.position) >= p.radius + q.radius) continue;
            REQUIRE(next < found.size());
            REQUIRE(found[next].a == a);
            REQUIRE(found[next].b == b);
            ++next;
        }
    CHECK(next == found.size());
    CHECK(next > 500);
}
