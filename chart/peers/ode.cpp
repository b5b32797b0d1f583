// ODE's world with a scene's balls in it.
#include "chart/peers/ode.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include <ode/ode.h>

#include "chart/peers/peer_runner.h"
#include "common/error.h"

namespace ballpit::chart {

namespace {

std::string textOf(const char* format, va_list values) {
    char text[256];
    std::vsnprintf(text, sizeof text, format, values);
    return text;
}

/// What ODE says goes here: messages come from a solver that found no solution.
std::string messageOfStep;  // NOLINT: ODE's handlers know no world
void noteMessage(int, const char* format, va_list values) {
    messageOfStep = textOf(format, values);
}

/// By itself ODE ends the program here, as it does when it meets a number that is none.
void refuseState(int, const char* format, va_list values) {
    throw NotFiniteError("ODE: " + textOf(format, values));
}

void initialiseOnce() {
    static const bool done = [] {
        dInitODE2(0);
        dSetMessageHandler(noteMessage);
        dSetDebugHandler(refuseState);
        return true;
    }();
    static_cast<void>(done);
}

Vec3 fromOde(const dReal* v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

enum class Solver { quick, dantzig };

/// Everything at ODE's defaults: ERP 0.2, CFM 1e-10, no limit to the correcting velocity. Its
/// manual recommends a surface layer of 1 mm against jitter: contacts keep that overlap, so it
/// makes our error larger (docs/peers.md), and we leave it at 0. Bodies do not fall asleep by
/// default.
class OdeWorld : public Peer {
public:
    OdeWorld(const Scene& scene, const PeerKnobs& knobs, Solver solver)
        : start_(scene.spheres), dt_(knobs.dt), solver_(solver) {
        dRandSetSeed(0);  // QuickStep shuffles the contacts: every world the same way
        dWorldSetGravity(world_, scene.gravity.x, scene.gravity.y, scene.gravity.z);
        dWorldSetQuickStepNumIterations(world_, knobs.iterations);
        for (const WallPlane& wall : wallPlanes(scene.bounds))
            dCreatePlane(space_, wall.normal.x, wall.normal.y, wall.normal.z, wall.offset);
        for (std::size_t k = 0; k < start_.count(); ++k) addBall(k);
    }
    ~OdeWorld() override {
        dJointGroupDestroy(joints_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    void step() override {
        contacts_ = 0;
        messageOfStep.clear();
        dSpaceCollide(space_, this, [](void* self, dGeomID a, dGeomID b) {
            static_cast<OdeWorld*>(self)->addContact(a, b);
        });
        if (solver_ == Solver::quick)
            dWorldQuickStep(world_, dt_);
        else
            dWorldStep(world_, dt_);
        dJointGroupEmpty(joints_);
        if (!messageOfStep.empty()) throw SolverGaveUp("ODE: " + messageOfStep);
        refuseFarBodies();
    }

    Spheres spheres() const override {
        return movedTo(start_, [&](std::size_t k) {
            return std::pair(fromOde(dBodyGetPosition(bodies_[k])),
                             fromOde(dBodyGetLinearVel(bodies_[k])));
        });
    }

    std::size_t contacts() const override { return contacts_; }

private:
    /// The next search for pairs would end the program: it numbers cells by integers.
    void refuseFarBodies() const {
        constexpr dReal farthest = 1e6;  // m
        for (const dBodyID body : bodies_) {
            const dReal* place = dBodyGetPosition(body);
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(place[axis]) < farthest))
                    throw NotFiniteError("ODE: a ball is " + std::to_string(place[axis]) +
                                         " m from the origin");
        }
    }

    void addBall(std::size_t k) {
        const Vec3 position = start_.positions[k], velocity = start_.velocities[k];
        dMass mass;
        dMassSetSphereTotal(&mass, start_.masses[k], start_.radii[k]);
        const dBodyID body = bodies_.emplace_back(dBodyCreate(world_));
        dBodySetMass(body, &mass);
        dBodySetPosition(body, position.x, position.y, position.z);
        dBodySetLinearVel(body, velocity.x, velocity.y, velocity.z);
        const dGeomID ball = dCreateSphere(space_, start_.radii[k]);
        dGeomSetBody(ball, body);
        dGeomSetData(ball, &start_.restitutions[k]);
    }

    /// If the two touch.
    void addContact(dGeomID a, dGeomID b) {
        const dBodyID first = dGeomGetBody(a), second = dGeomGetBody(b);
        if (!first && !second) return;  // two walls
        dContact contact{};
        if (dCollide(a, b, 1, &contact.geom, sizeof contact) == 0) return;
        contact.surface.mode = dContactBounce;
        contact.surface.bounce = std::min(restitutionOf(a), restitutionOf(b));
        dJointAttach(dJointCreateContact(world_, joints_, &contact), first, second);
        ++contacts_;
    }

    /// Walls have none of their own: what hits them decides.
    static float restitutionOf(dGeomID shape) {
        const auto* ofBall = static_cast<const float*>(dGeomGetData(shape));
        return ofBall ? *ofBall : 1.0f;
    }

    Spheres start_;
    float dt_;
    Solver solver_;
    dWorldID world_ = dWorldCreate();
    dSpaceID space_ = dHashSpaceCreate(nullptr);
    dJointGroupID joints_ = dJointGroupCreate(0);
    std::vector<dBodyID> bodies_;
    std::size_t contacts_ = 0;
};

std::unique_ptr<Peer> makeWorld(const Scene& scene, const PeerKnobs& knobs, Solver solver) {
    refuseForPeer(scene, knobs);
    initialiseOnce();
    return std::make_unique<OdeWorld>(scene, knobs, solver);
}

/// "ode 0.16.2, double".
std::string odeVersion() {
    return std::string("ode ") + dODE_VERSION +
           (sizeof(dReal) == sizeof(double) ? ", double" : ", float");
}

}  // namespace

std::unique_ptr<Peer> makeOde(const Scene& scene, const PeerKnobs& knobs) {
    return makeWorld(scene, knobs, Solver::quick);
}

std::unique_ptr<Peer> makeOdeDantzig(const Scene& scene, const PeerKnobs& knobs) {
    return makeWorld(scene, knobs, Solver::dantzig);
}

void addOde(Peers& peers) {
    const std::string engine = odeVersion();
    addMethod(peers, {engine, "ode", odeIterations, {10, 50, 100}, peerScenes, makeOde});
    addMethod(peers, {engine, "ode-dantzig", 0, {}, {"bounce", "column"}, makeOdeDantzig});
}

}  // namespace ballpit::chart
