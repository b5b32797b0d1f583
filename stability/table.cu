// ballpit_table: every scene of the catalogue under every method, one row each, every metric a
// column. `./ballpit maps --table` calls it.
#include <iostream>
#include <utility>

#include "common/cli.h"
#include "common/progress.h"
#include "common/whole_file.h"
#include "common/words.h"
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
        if (found == catalogue().end())
            throw InputError("scene '" + wanted + "': scenes with a row in the table are " +
                             commaSeparated(catalogue(), [](const Entry& e) { return e.name; }));
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

int run(const Asked& asked) {
    const std::vector<Entry> entries = entriesOf(asked.scenes);
    const std::vector<ResponseMethod> methods = methodsOf(asked.methods);
    requireUsable(asked.device);
    const std::string base = asked.out + "/stability_table_" + name(asked.device);
    requireOutFolder(asked.out);
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
    for (const auto& [ending, text] : {std::pair{".csv", csvOf(rows, asked.stamp)},
                                       std::pair{".md", markdownOf(rows, asked.stamp)}}) {
        writeWhole(base + ending, text);
        std::cout << base << ending << std::endl;
    }
    return exitOk;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Runs scenes of the catalogue under each method and writes all metrics of "
        "docs/stability.md: stability_table_DEVICE.csv and .md."};
    Asked asked;
    app.add_option("scenes", asked.scenes, "scenes to run (default: all)");
    app.add_option("--methods", asked.methods, "responses (default: all): " + responseNames());
    addDevice(app, asked.device);
    addOutput(app, asked.out, asked.stamp);
    if (const auto end = endAfterParsing(app, argc, argv)) return *end;
    return reportingErrors([&] { return run(asked); });
}
