// Bullet's discrete dynamics world with a scene's balls in it.
#include "chart/peers/bullet.h"

#include <algorithm>
#include <deque>

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <btBulletDynamicsCommon.h>
#include "chart/peers/peer_runner.h"

namespace ballpit::chart {

namespace {

btVector3 toBullet(Vec3 v) { return {v.x, v.y, v.z}; }
Vec3 fromBullet(const btVector3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// A contact's restitution as everywhere in Ballpit. By itself, Bullet multiplies the two.
btScalar smallerRestitution(const btCollisionObject* a, const btCollisionObject* b) {
    return std::min(a->getRestitution(), b->getRestitution());
}

bool hasBouncyBall(const Spheres& spheres) {
    return std::ranges::any_of(spheres.restitutions, [](float e) { return e > 0.0f; });
}

enum class Setup { advised, asPackaged };

class BulletWorld : public Peer {
public:
    BulletWorld(const Scene& scene, const PeerKnobs& knobs, Setup setup)
        : start_(scene.spheres),
          dt_(knobs.dt),
          maySleep_(setup == Setup::asPackaged),
          unbiased_(setup == Setup::advised && hasBouncyBall(scene.spheres)) {
        gCalculateCombinedRestitutionCallback = smallerRestitution;
        world_.setGravity(toBullet(scene.gravity));
        world_.getSolverInfo().m_numIterations = knobs.iterations;
        if (unbiased_) removeBias(world_.getSolverInfo());
        for (std::size_t k = 0; k < start_.count(); ++k) addBall(k);
        for (const WallPlane& wall : wallPlanes(scene.bounds)) addWall(wall);
    }
    ~BulletWorld() override {
        for (btRigidBody& body : bodies_) world_.removeRigidBody(&body);
    }

    void step() override {
        constexpr int exactlyOne = 0;  // this many substeps at most means: a step of just that time
        world_.stepSimulation(dt_, exactlyOne);
    }

    Spheres spheres() const override {
        return movedTo(start_, [&](std::size_t k) {
            return std::pair(fromBullet(bodies_[k].getCenterOfMassPosition()),
                             fromBullet(bodies_[k].getLinearVelocity()));
        });
    }

    std::size_t contacts() const override {
        std::size_t sum = 0;
        for (int k = 0; k < dispatcher_.getNumManifolds(); ++k) {
            const btPersistentManifold* touch = dispatcher_.getManifoldByIndexInternal(k);
            sum += static_cast<std::size_t>(touch->getNumContacts());
        }
        return sum;
    }

private:
    /// What Bullet's author advises where restitution matters (bullet3, issue 3094 and pull
    /// requests 1701, 3096): no speed below which nothing bounces, no contacts ahead of time
    /// (addBody), and overlap that is pushed apart without becoming speed. The last needs a
    /// threshold of 0: by default only overlaps beyond 4 cm, 0.4 of our smallest radii, are pushed
    /// so, and elastic balls gain energy. His fourth, no warm start, changes nothing here.
    static void removeBias(btContactSolverInfo& solver) {
        solver.m_restitutionVelocityThreshold = 0;
        solver.m_splitImpulsePenetrationThreshold = 0;
    }

    void addWall(const WallPlane& wall) {
        shapes_.push_back(std::make_unique<btStaticPlaneShape>(toBullet(wall.normal), wall.offset));
        addBody(0, toBullet({}), toBullet({}), 1);
    }

    void addBall(std::size_t k) {
        if (k == 0 || start_.radii[k] != start_.radii[k - 1])
            shapes_.push_back(std::make_unique<btSphereShape>(start_.radii[k]));
        addBody(start_.masses[k], toBullet(start_.positions[k]), toBullet(start_.velocities[k]),
                start_.restitutions[k]);
    }

    /// With the newest shape. A mass of 0 kg: it never moves.
    void addBody(btScalar mass, const btVector3& position, const btVector3& velocity,
                 btScalar restitution) {
        btVector3 inertia(0, 0, 0);
        if (mass > 0) shapes_.back()->calculateLocalInertia(mass, inertia);
        btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shapes_.back().get(), inertia);
        info.m_startWorldTransform.setOrigin(position);
        info.m_restitution = restitution;
        info.m_friction = 0;
        btRigidBody& body = bodies_.emplace_back(info);
        body.setLinearVelocity(velocity);
        if (unbiased_) body.setContactProcessingThreshold(0);
        if (!maySleep_ && mass > 0) body.setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(&body);
    }

    Spheres start_;
    float dt_;
    bool maySleep_, unbiased_;
    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_{&configuration_};
    btDbvtBroadphase broadPhase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_{&dispatcher_, &broadPhase_, &solver_, &configuration_};
    std::deque<std::unique_ptr<btCollisionShape>> shapes_;
    std::deque<btRigidBody> bodies_;  ///< the balls, then the walls; a deque never moves them
};

std::unique_ptr<Peer> makeWorld(const Scene& scene, const PeerKnobs& knobs, Setup setup) {
    refuseForPeer(scene, knobs);
    return std::make_unique<BulletWorld>(scene, knobs, setup);
}

/// "bullet 3.24, float".
std::string bulletVersion() {
    const int version = btGetVersion();
    return "bullet " + std::to_string(version / 100) + "." + std::to_string(version % 100) +
           (sizeof(btScalar) == sizeof(double) ? ", double" : ", float");
}

}  // namespace

std::unique_ptr<Peer> makeBullet(const Scene& scene, const PeerKnobs& knobs) {
    return makeWorld(scene, knobs, Setup::advised);
}

std::unique_ptr<Peer> makeBulletAsPackaged(const Scene& scene, const PeerKnobs& knobs) {
    return makeWorld(scene, knobs, Setup::asPackaged);
}

void addBullet(Peers& peers) {
    const std::string engine = bulletVersion();
    addMethod(peers, {engine, "bullet", bulletIterations, {4, 20, 50}, peerScenes, makeBullet});
    addMethod(
        peers,
        {engine, "bullet-as-packaged", bulletIterations, {}, peerScenes, makeBulletAsPackaged});
}

}  // namespace ballpit::chart
