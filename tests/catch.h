// Catch2 version 3, or version 2 where the distribution has only that: the difference ends here.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
using Catch::Generators::from_range;
#else
#include <catch2/catch.hpp>
using Catch::Generators::from_range;
#endif
