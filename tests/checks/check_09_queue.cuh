// Chapter 09: what two threads see of the queue between them, and in which order a reader is asked.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <thread>

#include "09_video_recording/capture.h"
#include "09_video_recording/frame_queue.h"
#include "tests/checks/check.h"

namespace ballpit::check {

constexpr auto patience = std::chrono::seconds(3);  ///< what takes longer waits for ever
constexpr auto moment = std::chrono::milliseconds(40);

/// Set when something waited for ever: a recording would, too.
inline bool& somethingHangs() {
    static bool hangs = false;
    return hangs;
}

/// Work on a thread of its own. A thread that never ends is left alone: what it uses must live on,
/// so the work shares its ownership.
class Background {
public:
    explicit Background(std::function<void()> work) {
        std::packaged_task<void()> task(std::move(work));
        end_ = task.get_future();
        std::thread(std::move(task)).detach();
    }
    bool isDone(std::chrono::milliseconds wait) {
        return end_.wait_for(wait) == std::future_status::ready;
    }
    /// True if it ends; what it threw is thrown here.
    bool ends() {
        if (!isDone(patience)) {
            somethingHangs() = true;
            return false;
        }
        end_.get();
        return true;
    }

private:
    std::future<void> end_;
};

/// What both threads share.
struct Traffic {
    explicit Traffic(std::size_t capacity) : queue(capacity) {}
    FrameQueue<int> queue;
    std::vector<int> popped;
    std::size_t most = 0;
    bool pushed = false, wasPopped = false;
    int refused = 0;
};

inline std::string listed(const std::vector<int>& numbers) {
    std::string list;
    for (std::size_t k = 0; k < numbers.size() && k < 12; ++k)
        list += (k ? ", " : "") + text(numbers[k]);
    return numbers.size() > 12 ? list + ", ..." : numbers.empty() ? "none" : list;
}

inline std::vector<int> upTo(int count) {
    std::vector<int> numbers;
    for (int k = 0; k < count; ++k) numbers.push_back(k);
    return numbers;
}

/// Everything goes in at one end and comes out at the other; `slow` delays one of the two threads.
inline void sendThrough(Report& report, const char* slow, bool slowPush, bool slowPop) {
    constexpr int count = 200;
    const auto traffic = std::make_shared<Traffic>(3);
    const auto nap = [](bool slow, int k) {
        if (slow && k % 10 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    Background consumer([=] {
        int item = -1;
        while (traffic->queue.pop(item)) {
            traffic->popped.push_back(item);
            nap(slowPop, item);
        }
    });
    Background producer([=] {
        for (int k = 0; k < count; ++k) {
            int item = k;
            if (!traffic->queue.push(item)) ++traffic->refused;
            traffic->most = std::max(traffic->most, traffic->queue.size());
            nap(slowPush, k);
        }
        traffic->queue.close();
    });
    const std::string where = std::string(" (") + slow + ")";
    if (!producer.ends()) return report.fail("push waits for ever" + where);
    if (!consumer.ends()) return report.fail("pop waits for ever" + where);
    if (traffic->most > 3)
        report.fail("most in a queue for 3" + where, text(traffic->most), "at most 3");
    if (traffic->popped != upTo(count))
        report.fail("popped after 0 to 199 were pushed" + where,
                    text(traffic->popped.size()) + ": " + listed(traffic->popped),
                    "200: " + listed(upTo(count)));
    const std::vector<int>& got = traffic->popped;
    report.guess(
        {{"no waiting: the queue grows as long as the encoder is slower",
          [&] { return traffic->most > 3; }},
         {"frames are dropped when the queue is full",
          [&] {
              return got.size() < upTo(count).size() && std::is_sorted(got.begin(), got.end());
          }},
         {"last in, first out: the newest frame overtakes the older ones", [&] {
              return got.size() == upTo(count).size() && !std::is_sorted(got.begin(), got.end());
          }}});
}

inline void queueKeepsOrder(Report& report) {
    sendThrough(report, "both at full speed", false, false);
    if (!report.failed()) sendThrough(report, "the encoder is slower", false, true);
    if (!report.failed()) sendThrough(report, "the drawing is slower", true, false);
}

inline void queueIsBounded(Report& report) {
    const auto traffic = std::make_shared<Traffic>(2);
    Background first([=] {
        for (int k : {0, 1}) traffic->queue.push(k);
    });
    if (!first.ends()) return report.fail("push waits although there is room");
    if (traffic->queue.size() != 2)
        return report.fail("in the queue after two pushes", text(traffic->queue.size()), "2");
    Background third([=] {
        int item = 2;
        traffic->pushed = traffic->queue.push(item);
    });
    const bool waited = !third.isDone(moment);
    if (!waited) {
        report.fail("a push to a full queue of 2",
                    traffic->pushed ? "returned true at once" : "returned false at once",
                    "waits for room");
        const std::size_t inside = traffic->queue.size();
        report.guess({{"no waiting: the queue grows as long as the encoder is slower",
                       [&] { return inside > 2; }},
                      {"frames are dropped when the queue is full", [&] { return inside <= 2; }}});
    }
    Background pop([=] {
        int item = -1;
        traffic->queue.pop(item);
        traffic->popped.push_back(item);
    });
    if (!pop.ends()) return report.fail("pop waits although the queue is full");
    if (traffic->popped[0] != 0)
        report.fail("popped first after 0, 1, 2", text(traffic->popped[0]), "0");
    if (!third.ends())
        return report.fail("a push that waited", "waits on although there is room again",
                           "goes on: pop tells the thread that waits");
    if (waited && !traffic->pushed) report.fail("a push that waited for room", "false", "true");
}

inline void closingEndsIt(Report& report) {
    const auto full = std::make_shared<Traffic>(1), empty = std::make_shared<Traffic>(1);
    Background fill([=] {
        int item = 0;
        full->queue.push(item);
    });
    if (!fill.ends()) return report.fail("push waits although there is room");
    Background push([=] {
        int item = 1;
        full->pushed = full->queue.push(item);
    });
    Background pop([=] {
        int item = -1;
        empty->wasPopped = empty->queue.pop(item);
    });
    if (pop.isDone(moment)) report.fail("a pop from an empty queue", "returned", "waits");
    push.isDone(moment);
    full->queue.close();
    empty->queue.close();
    if (!push.ends())
        report.fail("a push that waits while the queue is closed", "waits for ever",
                    "returns false");
    else if (full->pushed)
        report.fail("a push that waits while the queue is closed", "true", "false");
    if (!pop.ends())
        report.fail("a pop that waits while the queue is closed", "waits for ever",
                    "returns false");
    else if (empty->wasPopped)
        report.fail("a pop that waits while the queue is closed", "true", "false");
    report.guess({{"who waits must also wake up when the queue is closed",
                   [] { return somethingHangs(); }}});
    if (report.failed()) return;
    Background rest([=] {
        int item = -1;
        full->wasPopped = full->queue.pop(item) && item == 0;
    });
    if (!rest.ends() || !full->wasPopped) {
        report.fail("what was pushed before the end", "lost", "popped before pop returns false");
        report.guess(
            {{"the frames that are still in the queue at the end are lost", [] { return true; }}});
    }
}

// ---- capture

/// Notes what it is asked for.
struct NotingReader {
    int started = 0, fetched = 0;
    std::vector<std::string>* events;
    void start() { events->push_back("start " + text(started++)); }
    void fetch(Pixels& pixels) {
        events->push_back("fetch " + text(fetched));
        pixels.width = fetched++;
    }
    int underWay() const { return started - fetched; }
};

inline std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all.empty() ? "nothing" : all;
}

inline void frameByFrame(Report& report) {
    std::vector<std::string> events;
    NotingReader reader{.events = &events};
    Pixels pixels;
    std::string before;
    for (int k = 0; k < 4; ++k) {
        events.clear();
        captureDrawn(reader, pixels,
                     [&](Pixels& taken) { events.push_back("hand on " + text(taken.width)); });
        const std::string last = text(k - 1),
                          expected = "start " + text(k) +
                                     (k ? ", fetch " + last + ", hand on " + last : "");
        if (joined(events) != expected)
            report.fail("after frame " + text(k) + " was drawn", joined(events), expected);
        const std::string got = joined(events), now = text(k);
        report.guess(
            {{"each frame is fetched at once: the drawing waits for its copy",
              [&] { return got == "start " + now + ", fetch " + now + ", hand on " + now; }},
             {"the frame before is fetched first: this one's copy begins later than it could",
              [&] { return got == "fetch " + last + ", hand on " + last + ", start " + now; }},
             {"fetched before there was one: after the first frame none is before it",
              [&] { return k == 0 && reader.fetched > 0; }}});
    }
}

inline void restIsHandedOn(Report& report) {
    for (const int underWay : {0, 1, 2}) {
        std::vector<std::string> events;
        NotingReader reader{.started = 5 + underWay, .fetched = 5, .events = &events};
        Pixels pixels;
        captureRest(reader, pixels,
                    [&](Pixels& taken) { events.push_back("hand on " + text(taken.width)); });
        std::vector<std::string> expected;
        for (int k = 5; k < 5 + underWay; ++k) {
            expected.push_back("fetch " + text(k));
            expected.push_back("hand on " + text(k));
        }
        if (events != expected)
            report.fail("at the end, with " + text(underWay) + " frames under way", joined(events),
                        joined(expected));
    }
    report.guess(
        {{"the last frame stays where it is: the video is one frame short", [] { return true; }}});
}

}  // namespace ballpit::check
