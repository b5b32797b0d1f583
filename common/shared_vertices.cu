// Registers an OpenGL buffer with CUDA and lets a kernel write it, or copies through main memory.
#include "common/shared_vertices.h"

#include <GL/glew.h>

#include "common/rigid_body.cuh"

#ifdef BALLPIT_CUDA
#include <cuda_gl_interop.h>
#endif

namespace ballpit {

namespace {

/// Body ids[i] lies in slot i; its vertex is number ids[i].
HD inline void writeVertex(int i, View<const std::uint32_t> ids, View<const Vec4> positions,
                           View<Vec4> vertices) {
    vertices[ids[i]] = positions[i];
}

void launchWriteVertices(RigidBodySystem& bodies, View<Vec4> vertices) {
    const BodiesView state = bodies.view(bodies.state());
    launch<writeVertex>(bodies.device(), static_cast<int>(bodies.count()), state.ids,
                        state.positions, vertices);
}

}  // namespace

#ifdef BALLPIT_CUDA

namespace {

/// Empty if the current OpenGL context runs on the GPU that CUDA uses; else why that is not so.
std::string whyApart() {
    unsigned count = 0;
    int device = 0, current = 0;
    const cudaError_t code = cudaGLGetDevices(&count, &device, 1, cudaGLDeviceListAll);
    cudaGetLastError();  // a refusal here is an answer, not an error of the next call
    if (code != cudaSuccess || count == 0) {
        const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        return std::string("OpenGL (") + (renderer ? renderer : "unknown") +
               ") and CUDA do not share a GPU: " + cudaGetErrorString(code);
    }
    checkCuda(cudaGetDevice(&current), "cudaGetDevice");
    if (device != current) return "OpenGL runs on another GPU than CUDA";
    return {};
}

}  // namespace

struct SharedVertices::Registration {
    cudaGraphicsResource_t resource = nullptr;

    ~Registration() { cudaGraphicsUnregisterResource(resource); }

    static std::unique_ptr<Registration> make(unsigned buffer, std::string& whyNot) {
        whyNot = whyApart();
        if (!whyNot.empty()) return nullptr;
        cudaGraphicsResource_t resource = nullptr;
        const cudaError_t code =
            cudaGraphicsGLRegisterBuffer(&resource, buffer, cudaGraphicsRegisterFlagsWriteDiscard);
        cudaGetLastError();
        if (code == cudaSuccess) return std::unique_ptr<Registration>(new Registration{resource});
        whyNot = std::string("the driver refuses to share an OpenGL buffer with CUDA: ") +
                 cudaGetErrorString(code);
        return nullptr;
    }

    void write(RigidBodySystem& bodies) {
        checkCuda(cudaGraphicsMapResources(1, &resource, cudaStream), "cudaGraphicsMapResources");
        void* address = nullptr;
        std::size_t bytes = 0;
        checkCuda(cudaGraphicsResourceGetMappedPointer(&address, &bytes, resource),
                  "cudaGraphicsResourceGetMappedPointer");
        View<Vec4> vertices;
        vertices.data = static_cast<Vec4*>(address);
        vertices.count = static_cast<std::uint32_t>(bytes / sizeof(Vec4));
        launchWriteVertices(bodies, vertices);
        // OpenGL's next commands wait for what the stream still does.
        checkCuda(cudaGraphicsUnmapResources(1, &resource, cudaStream),
                  "cudaGraphicsUnmapResources");
    }
};

#else

struct SharedVertices::Registration {
    static std::unique_ptr<Registration> make(unsigned, std::string&) { return nullptr; }
    void write(RigidBodySystem&) {}
};

#endif

SharedVertices::SharedVertices(RigidBodySystem& bodies, unsigned buffer, bool mayShare)
    : bodies_(bodies), buffer_(buffer) {
    if (mayShare && bodies.device() == Device::cuda)
        registration_ = Registration::make(buffer, notice_);
    if (!notice_.empty()) notice_ += "; positions go through main memory, with the same picture";
}

SharedVertices::~SharedVertices() = default;

bool SharedVertices::isDirect() const { return registration_ != nullptr; }

void SharedVertices::update() {
    if (isDirect())
        registration_->write(bodies_);
    else
        updateThroughHost();
}

void SharedVertices::updateThroughHost() {
    DeviceBuffer<Vec4> vertices(bodies_.device(), bodies_.count(), "vertices");
    launchWriteVertices(bodies_, vertices.view());
    const std::vector<Vec4> copy = vertices.download();
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(copy.size() * sizeof(Vec4)),
                    copy.data());
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

}  // namespace ballpit
