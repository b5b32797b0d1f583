// The film of a build without graphics: refuses politely.
#include "common/film.h"

#include "common/error.h"

namespace ballpit {

struct Film::Crew {};
class SharedVertices {};

Film::Film(const FilmOrder& order, Bounds) {
    if (!order.video.empty() || !order.lastPicture.empty() || !order.stills.empty())
        throw InputError(
            "this build has no graphics, so --out, --png and --stills cannot be used: install the "
            "packages "
            "named in docs/dependencies.md and configure again, or leave them "
            "away");
}

Film::~Film() = default;
void Film::look(const Camera&, DrawStyle) {}
void Film::capture(const std::vector<Vec3>&, const std::vector<float>&, const std::vector<Vec3>&,
                   const std::string&) {}
void Film::capture(RigidBodySystem&, const std::vector<float>&, const std::vector<Vec3>&,
                   const std::string&) {}
void Film::finish() {}

}  // namespace ballpit
