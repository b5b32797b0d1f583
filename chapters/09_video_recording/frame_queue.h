// A queue between two threads: one draws, one encodes, and neither runs away from the other.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>
#include "common/hole.cuh"

namespace ballpit {

/// First in, first out, and never more than `capacity` inside. One thread pushes, another pops.
template <class Item>
class FrameQueue {
public:
    explicit FrameQueue(std::size_t capacity) : capacity_(capacity) {}

    /// Adds an item at the end; waits while the queue is full. False, and the item is not taken, if
    /// the queue is closed: also if it is closed while this waits.
    bool push(Item& item) {
        // ---- hole queue.push (about 6 lines): Wait while the queue is full; then add the item at the end
        TODO_HOLE("queue.push");
        return false;
        // ---- end of queue.push
    }

    /// Takes the first item; waits while there is none. False if there is none and the queue is
    /// closed: what was pushed before the end is popped first.
    bool pop(Item& item) {
        // ---- hole queue.pop (about 7 lines): Wait for an item; then take the first
        TODO_HOLE("queue.pop");
        return false;
        // ---- end of queue.pop
    }

    /// No more items will be pushed, or none will be popped. Wakes whoever waits.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

    std::size_t size() const {
        const std::lock_guard lock(mutex_);
        return items_.size();
    }

private:
    const std::size_t capacity_;
    mutable std::mutex mutex_;         // for all that follows
    std::condition_variable changed_;  // tells that a thread which waits should look again
    std::deque<Item> items_;
    bool closed_ = false;
};

}  // namespace ballpit
