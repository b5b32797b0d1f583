// All scenes of this folder by name: what each asks, what it is held against, how exactly, and
// which knobs it has. docs/stability.md shows this table.
#pragma once

#include <span>
#include <string>

#include "common/scene.h"

namespace ballpit::stability {

struct Entry {
    const char* name;
    int usualCount, leastCount, mostCount;  ///< of balls
    Scene (*make)(int count, std::uint64_t seed);
    const char* question;   ///< in one line
    const char* truth;      ///< what the answer is held against: a file of truth/, or a law
    double within;          ///< how near a response must come: a number for charts; 0 means exactly
    const char* tolerance;  ///< the same in words; {} stands for the number
    const char* knobs;      ///< of the function in scenes.h
};

std::span<const Entry> catalogue();

/// "rms 0.02 r".
std::string toleranceText(const Entry& entry);

}  // namespace ballpit::stability
