// Owns the event-driven simulator of hard spheres: no steps, it goes from collision to collision
// and computes each one's moment exactly. The truth for gases, coolings and few-body collisions, as
// far as the model goes: contacts without duration, two balls at a time, no friction.
//
// Cells and one queue of predicted events, as in Rapaport, "The event scheduling problem in
// molecular dynamic simulation" (1980). A ball is brought up to date only when something happens to
// it.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <queue>
#include <vector>

#include "truth/event_cells.h"

namespace ballpit::truth {

struct EventSettings {
    Box box;                ///< m
    bool periodic = false;  ///< what leaves on one side comes in on the other; otherwise walls
    Vector gravity;         ///< m/s^2; zero if periodic
    /// s: a ball that collides again this soon does so elastically. Ends the infinitely many
    /// collisions in which inelastic balls come to rest (the TC model of Luding and McNamara 1998).
    double contactTime = 0;
};

/// What has happened since the start, or since counting began anew.
struct EventCounts {
    std::uint64_t collisions = 0;            ///< of two balls
    std::uint64_t wallCollisions = 0;        ///< of a ball and a wall
    std::uint64_t elasticByContactTime = 0;  ///< of both kinds
    std::uint64_t overlapping = 0;           ///< collisions of two that overlapped beyond rounding
    double virial = 0;                       ///< J: sum of distances times impulses
    double since = 0;                        ///< s: when counting began
};

class EventDriven {
public:
    /// std::invalid_argument if the balls do not fit the box (see EventCells), or if there is
    /// gravity in a periodic one.
    EventDriven(Balls balls, const EventSettings& settings);

    /// Goes on until `time`, s, or until this many more collisions (with walls too) have happened.
    /// If no event is left and `time` is infinite, the clock stands at the last one.
    void runUntil(double time, std::uint64_t mostCollisions = UINT64_MAX);

    double time() const { return now_; }
    const EventCounts& counts() const { return counts_; }
    void resetCounts();

    /// All balls as of time(); in a periodic box their positions are inside it.
    Balls balls() const;

    /// How many things are wrong now: overlapping pairs, balls outside the walls, values that are
    /// not finite. 0 in a valid state. Compares every two balls.
    int invalidStates() const;

    /// s: mean time between two collisions (of two balls) of one ball, since counting began.
    double meanFreeTime() const;

    /// Z = P V / (N T) by the virial of the collisions since counting began, at the present
    /// temperature: of use when the gas is elastic and periodic. 1 for an ideal gas.
    double compressibility() const;

private:
    enum class Kind { collision, wall, crossing };
    struct Event {
        double time;
        Kind kind;
        int ball, partner;                      ///< the other ball, or the face of wall or cell
        std::uint32_t ballCount, partnerCount;  ///< their collisions when it was predicted
        bool operator>(const Event& other) const { return time > other.time; }
    };
    using Queue = std::priority_queue<Event, std::vector<Event>, std::greater<>>;

    Ball asOfNow(int ball) const;
    void advance(int ball);

    void predictAll();
    void predictPair(int a, int b);
    void predictPairsIn(int ball, Cell from, Cell to);
    void predictPairs(int ball);
    void predictFaces(int ball);

    bool happens(const Event& event) const;
    void handle(const Event& event);
    void cross(int ball, int face);
    void collideWithWall(int ball, int face);
    void collidePair(int a, int b);
    double restitutionNow(std::initializer_list<int> balls, double restitution);

    EventSettings settings_;
    Balls balls_;  ///< each as of its own moment in asOf_
    EventCells cells_;
    std::vector<double> asOf_, lastCollision_;
    std::vector<std::uint32_t> collisionCount_;
    Queue queue_;
    double now_ = 0;
    EventCounts counts_;
};

}  // namespace ballpit::truth
