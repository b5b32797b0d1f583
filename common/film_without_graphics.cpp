// The film of a build without graphics: refuses politely.
#include "common/film.h"

#include "common/error.h"

namespace ballpit {

struct Film::Crew {};

Film::Film(const Options& options, Bounds) {
    if (!options.out.empty() || !options.png.empty() || !options.stills.empty())
        throw InputError(
            "this build has no graphics, so --out, --png and --stills cannot be used: install the "
            "packages "
            "named in docs/dependencies.md and configure again, or leave them "
            "away");
}

Film::~Film() = default;
void Film::capture(const std::vector<Vec3>&, const std::vector<float>&, const std::vector<Vec3>&) {}
void Film::finish() {}

}  // namespace ballpit
