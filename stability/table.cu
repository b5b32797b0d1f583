// ballpit_table: every scene of the catalogue under every method, one row each, every metric a
// column. `./ballpit maps --table` calls it.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "common/cli.h"
#include "common/csv.h"
#include "common/progress.h"
#include "stability/run_table.cuh"

using namespace ballpit;
using namespace ballpit::stability;

namespace {

struct Asked {
    std::vector<std::string> scenes, methods;
    Device device = Device::cpu;
    std::string out = ".", stamp;
};

std::vector<Entry> entriesOf(const std::vector<std::string>& names) {
    if (names.empty()) return {catalogue().begin(), catalogue().end()};
    std::vector<Entry> entries;
    for (const std::string& wanted : names) {
        const auto found = std::find_if(catalogue().begin(), catalogue().end(),
                                        [&](const Entry& e) { return e.name == wanted; });
        if (found == catalogue().end()) {
            std::string known;
            for (const Entry& e : catalogue())
                known += (known.empty() ? "" : ", ") + std::string(e.name);
            throw InputError("scene '" + wanted + "': scenes with a row in the table are " + known);
        }
        entries.push_back(*found);
    }
    return entries;
}

std::vector<ResponseMethod> methodsOf(const std::vector<std::string>& names) {
    if (names.empty()) return allMethods();
    std::vector<ResponseMethod> methods;
    for (const std::string& name : names) methods.push_back(responseMethod(name));
    return methods;
}

/// The file appears under its name only when it is complete.
void write(const std::string& path, const std::string& text) {
    const std::string part = path + ".part";
    {
        std::ofstream file(part);
        file << text;
        if (!file.flush()) {
            file.close();
            std::filesystem::remove(part);
            throw std::runtime_error(path + ": writing failed (disk full?); nothing was left");
        }
    }
    std::filesystem::rename(part, path);
    std::cout << path << std::endl;
}

int run(const Asked& asked) {
    const std::vector<Entry> entries = entriesOf(asked.scenes);
    const std::vector<ResponseMethod> methods = methodsOf(asked.methods);
    if (asked.device == Device::cuda && !cudaUsable())
        throw InputError("--device cuda: " + whyCudaIsUnusable());
    const std::string base = asked.out + "/stability_table_" + name(asked.device);
    if (!std::filesystem::is_directory(asked.out))
        throw InputError("--out " + asked.out + ": is not a folder");
    requireWritable(base + ".csv");
    requireWritable(base + ".md");
    const StopRequest stop;
    std::vector<TableRow> rows;
    for (const Entry& entry : entries) {
        std::fprintf(stderr, "%s: %zu methods\n", entry.name, methods.size());
        for (const ResponseMethod method : methods) {
            constexpr int stoppedByUser = 130;
            if (StopRequest::received()) return stoppedByUser;
            rows.push_back(rowOf(entry, method, asked.device));
        }
    }
    write(base + ".csv", csvOf(rows, asked.stamp));
    write(base + ".md", markdownOf(rows, asked.stamp));
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Runs scenes of the catalogue under each method and writes all metrics of "
        "docs/stability.md: stability_table_DEVICE.csv and .md."};
    Asked asked;
    std::string device = name(Device::cpu);
    app.add_option("scenes", asked.scenes, "scenes to run (default: all)");
    app.add_option("--methods", asked.methods, "responses (default: all): " + responseNames());
    app.add_option("--device", device, "cuda or cpu")
        ->check(CLI::IsMember({"cuda", "cpu"}))
        ->capture_default_str();
    app.add_option("--out", asked.out, "folder for the files")->capture_default_str();
    app.add_option("--stamp", asked.stamp, "lines for the files' head: machine, commit, command");
    if (const auto end = endAfterParsing(app, argc, argv)) return *end;
    asked.device = device == "cuda" ? Device::cuda : Device::cpu;
    return reportingErrors([&] { return run(asked); });
}
