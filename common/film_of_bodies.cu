// The film of bodies on a device: the shortest way from the physics to the picture.
#include <iostream>

#include "common/film.h"
#include "common/rigid_body.cuh"
#include "common/shared_vertices.h"

namespace ballpit {

/// Fills the renderer's buffer, if that saves the way through main memory.
bool Film::fillsBuffer(RigidBodySystem& bodies) {
    if (bodies.device() == Device::cpu || !renderer().drawsPoints(bodies.count())) return false;
    if (!vertices_) {
        const unsigned buffer = renderer().positionBuffer(bodies.count());
        vertices_ = std::make_unique<SharedVertices>(bodies, buffer);
        if (!vertices_->isDirect()) std::cerr << "note: " << vertices_->notice() << '\n';
    }
    if (vertices_->isDirect()) vertices_->update();
    return vertices_->isDirect();
}

void Film::capture(RigidBodySystem& bodies, const std::vector<float>& radii,
                   const std::vector<Vec3>& colors, const std::string& text) {
    if (fillsBuffer(bodies))
        captureFromBuffer(bodies.largestRadius(), colors, text);
    else
        capture(bodies.positions.download(), radii, colors, text);
}

}  // namespace ballpit
