// Runs checks and tells what happens as events (docs/authoring.md, "Checks").
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>

#include "common/error.h"
#include "common/hole.cuh"
#include "common/words.h"
#include "tests/checks/check.h"

namespace ballpit::check {

namespace {

using nlohmann::json;

struct Request {
    std::string device = "all", onlyCase, after, picture, events;
    std::uint64_t seed = 1;
    bool list = false;
};

/// The verdict's exit codes, as docs/authoring.md has them.
enum VerdictCode { correct = 0, todo = 10, cudaError = 12, wrong = 13, racy = 14 };

/// Writes events to the file that was asked for, else a line a result to stdout.
class Log {
public:
    explicit Log(const std::string& path) {
        if (path.empty()) return;
        file_.open(path);
        if (!file_) throw InputError("cannot write '" + path + "'");
    }

    void write(const json& event) {
        if (file_.is_open())
            file_ << event.dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
        else
            show(event);
    }

private:
    static void show(const json& event) {
        const std::string kind = event["event"];
        if (kind == "hole") std::cout << "open hole: " << std::string(event["id"]) << '\n';
        if (kind == "measured") std::cout << std::string(event["text"]) << '\n';
        if (kind != "result") return;
        std::cout << std::string(event["state"]) << ": " << std::string(event["id"]) << " on "
                  << std::string(event["device"]) << '\n';
        for (const json& failure : event["failures"])
            std::cout << "    " << std::string(failure["what"]) << ": got "
                      << std::string(failure["got"]) << ", expected "
                      << std::string(failure["expected"]) << '\n';
        const std::string message = event["message"];
        if (!message.empty()) std::cout << "    " << message << '\n';
    }

    std::ofstream file_;
};

std::vector<Device> devicesFor(const std::string& word) {
    if (word == "cpu") return {Device::cpu};
    if (word == "all" && !cudaUsable()) return {Device::cpu};
    requireUsable(Device::cuda);
    if (word == "cuda") return {Device::cuda};
    return {Device::cpu, Device::cuda};
}

/// The reason without the advice: nobody asked for the GPU.
std::string whyNoCuda() {
    const std::string why = whyCudaIsUnusable();
    return why.substr(0, why.find(": use"));
}

json startEvent(const std::string& chapter, const Request& request,
                const std::vector<Device>& devices) {
    json start{{"event", "start"}, {"chapter", chapter}, {"seed", request.seed}};
    start["devices"] = json::array();
    for (const Device device : devices) start["devices"].push_back(name(device));
    start["skipped"] = json::array();
    if (request.device == "all" && !cudaUsable())
        start["skipped"].push_back({{"device", "cuda"}, {"why", whyNoCuda()}});
    return start;
}

json resultEvent(const Check& check, const Report& report, const std::string& state) {
    json result{{"event", "result"},
                {"id", check.id},
                {"claim", check.claim},
                {"device", name(report.device)},
                {"state", state},
                {"failure_count", report.failureCount},
                {"message", report.message},
                {"looks_like", report.looksLike}};
    result["failures"] = json::array();
    for (const Failure& f : report.failures)
        result["failures"].push_back({{"what", f.what}, {"got", f.got}, {"expected", f.expected}});
    return result;
}

/// Everything that one call of the program does.
class Run {
public:
    Run(const Request& request, const std::function<std::vector<std::string>()>& takeHoles)
        : request_(request), takeHoles_(takeHoles), log_(request.events) {
        // At once, not after the check: an open hole may well lead to a crash.
        current_ = this;
        holeListener() = [](const char* id) { current_->tellHole(id); };
    }
    ~Run() { holeListener() = nullptr; }
    Run(const Run&) = delete;

    VerdictCode all(const std::string& chapter, const std::vector<Check>& checks) {
        std::vector<Device> devices = devicesFor(request_.device);
        log_.write(startEvent(chapter, request_, devices));
        bool reached = request_.after.empty();
        for (const Check& check : checks) {
            const bool due =
                reached && (request_.onlyCase.empty() || request_.onlyCase == check.id);
            for (std::size_t k = 0; due && k < devices.size(); ++k) {
                // After a CUDA error the GPU answers nothing any more.
                if (one(check, devices[k]) == cudaError) devices.erase(devices.begin() + k--);
            }
            reached = reached || request_.after == check.id;
        }
        log_.write({{"event", "end"}});
        for (const VerdictCode code : {todo, cudaError, wrong, racy})
            if (codes_.count(code)) return code;
        return correct;
    }

private:
    VerdictCode one(const Check& check, Device device) {
        log_.write({{"event", "case"}, {"id", check.id}, {"device", name(device)}});
        Report report(device, request_.seed, pictureDrawn_ ? "" : request_.picture);
        VerdictCode code = correct;
        try {
            check.body(report);
            if (report.failed()) code = report.isRacy && report.failureCount == 0 ? racy : wrong;
        } catch (const CudaError& error) {
            report.message = error.what();
            code = cudaError;
        } catch (const std::exception& error) {
            report.fail(std::string("stopped by an exception: ") + error.what());
            code = wrong;
        }
        const bool open = tellHoles();
        for (const std::string& text : report.measurements)
            log_.write({{"event", "measured"}, {"text", text}});
        if (!report.picturePath.empty()) {
            pictureDrawn_ = true;
            log_.write({{"event", "picture"}, {"path", report.picturePath}});
        }
        static const std::map<VerdictCode, std::string> names{
            {correct, "passed"}, {cudaError, "cuda error"}, {wrong, "wrong"}, {racy, "racy"}};
        json result = resultEvent(check, report, names.at(code));
        result["open"] = open;
        log_.write(result);
        if (code != correct) codes_.insert(code);
        return code;
    }

    /// True if the last check met an open hole.
    bool tellHoles() {
        const std::vector<std::string> ids = takeHoles_();
        for (const std::string& id : ids) tellHole(id);
        return !ids.empty();
    }

    /// Kernels on several threads may meet holes at the same time.
    void tellHole(const std::string& id) {
        const std::lock_guard lock(holesMutex_);
        codes_.insert(todo);
        if (holes_.insert(id).second) log_.write({{"event", "hole"}, {"id", id}});
    }

    static inline Run* current_ = nullptr;
    const Request& request_;
    const std::function<std::vector<std::string>()>& takeHoles_;
    Log log_;
    std::mutex holesMutex_;
    std::set<std::string> holes_;
    std::set<VerdictCode> codes_;
    bool pictureDrawn_ = false;
};

void requireKnown(const std::string& id, const std::vector<Check>& checks) {
    for (const Check& check : checks)
        if (id.empty() || check.id == id) return;
    throw InputError("unknown check '" + id + "': there are " +
                     commaSeparated(checks, [](const Check& check) { return check.id; }));
}

void printList(const std::vector<Check>& checks) {
    json list = json::array();
    for (const Check& check : checks)
        list.push_back({{"id", check.id}, {"claim", check.claim}, {"why", check.why}});
    std::cout << list.dump(1) << '\n';
}

}  // namespace

int runChecks(int argc, char** argv, const std::string& chapter, const std::vector<Check>& checks,
              const std::function<std::vector<std::string>()>& takeHoles) {
    // Line by line also into a pipe: what a student printed must survive the crash it looks for.
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    CLI::App app{"Checks of chapter " + chapter + ". `./ballpit check " + chapter +
                 "` builds and runs them and says more."};
    Request request;
    app.add_option("--device", request.device, "where to run")
        ->check(CLI::IsMember({"cpu", "cuda", "all"}))
        ->capture_default_str();
    app.add_option("--seed", request.seed, "of the random scenes")->capture_default_str();
    app.add_option("--case", request.onlyCase, "only the check with this id");
    app.add_option("--after", request.after, "only the checks behind the one with this id");
    app.add_option("--picture", request.picture, "PNG to draw the first fault in space to");
    app.add_option("--events", request.events, "file for events, one JSON object a line");
    app.add_flag("--list", request.list, "all checks as JSON");
    CLI11_PARSE(app, argc, argv);
    return reportingErrors([&]() -> int {
        requireKnown(request.onlyCase, checks);
        requireKnown(request.after, checks);
        if (request.list) return printList(checks), exitOk;
        return Run(request, takeHoles).all(chapter, checks);
    });
}

}  // namespace ballpit::check
