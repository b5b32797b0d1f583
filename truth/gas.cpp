// Implements the starting states of gases.
#include "truth/gas.h"

#include <cmath>
#include <numbers>

#include "common/random.h"

namespace ballpit::truth {

namespace {

/// In (0, 1]: all 53 bits of a double, never 0, so that its logarithm is finite.
double uniform(Random& random) { return (static_cast<double>(random.next() >> 11) + 1) * 0x1p-53; }

/// Normal with mean 0 and variance 1 (Box and Muller 1958).
double normal(Random& random) {
    const double distance = std::sqrt(-2 * std::log(uniform(random)));
    return distance * std::cos(2 * std::numbers::pi * uniform(random));
}

void setTemperature(Balls& balls, double wanted) {
    const Vector sum = momentum(balls);
    const double share = 1 / static_cast<double>(balls.size());
    for (Ball& ball : balls) ball.velocity -= (share / ball.mass) * sum;
    const double scale = std::sqrt(wanted / temperature(balls));
    for (Ball& ball : balls) ball.velocity = scale * ball.velocity;
}

}  // namespace

Gas latticeGas(const GasSettings& s, bool walled) {
    const double sigma = 2 * s.radius, step = sigma * std::cbrt(4 / s.density);
    const double side = step * s.cellsPerSide;
    Gas gas{{}, {{}, {side, side, side}}};
    Random random(s.seed);
    // Half a place from both sides; between walls the outer centres keep a radius and a bit away.
    const double places = 2 * s.cellsPerSide;
    const double margin = walled ? std::max(side / places / 2, 1.001 * s.radius) : 0;
    const double spacing = walled ? (side - 2 * margin) / (places - 1) : step / 2;
    for (int z = 0; z < places; ++z)
        for (int y = 0; y < places; ++y)
            for (int x = 0; x < places; ++x) {
                if ((x + y + z) % 2 != 0) continue;  // every second place of the cubic lattice
                const Vector place{x * spacing + margin, y * spacing + margin,
                                   z * spacing + margin};
                const double vx = normal(random), vy = normal(random), vz = normal(random);
                gas.balls.push_back({place, {vx, vy, vz}, s.radius, s.mass, s.restitution});
            }
    setTemperature(gas.balls, s.temperature);
    return gas;
}

}  // namespace ballpit::truth
