// Two threads, one picture: what one thread made reaches the other without either waiting for the
// other's work.
#pragma once

#include <mutex>
#include <utility>

namespace ballpit {

/// Holds the newest value that was published until it is taken. Three values are in use: the
/// writer's, the reader's and the one in between. They are swapped, never copied, so the lock is
/// held for a moment only, and the memory of old values is used again.
template <class T>
class Handover {
public:
    /// Hands over the value. An older one, to be overwritten, comes back in its place.
    void publish(T& value) {
        const std::lock_guard lock(mutex_);
        std::swap(between_, value);
        isNew_ = true;
    }

    /// Takes the newest value if there is one that was not taken yet.
    bool take(T& value) {
        const std::lock_guard lock(mutex_);
        if (!isNew_) return false;
        std::swap(between_, value);
        isNew_ = false;
        return true;
    }

    /// True if the last value was taken: a new one would be seen.
    bool isAwaited() const {
        const std::lock_guard lock(mutex_);
        return !isNew_;
    }

private:
    mutable std::mutex mutex_;
    T between_{};
    bool isNew_ = false;
};

}  // namespace ballpit
