// What a user asks for: files of balls, options, the command line. Each mistake must be named
// (where, what, and what would be right), and nothing may have changed.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "common/csv.h"
#include "common/whole_file.h"
#include "tests/command_line.h"
#include "tests/support.h"

using namespace ballpit;
using test::CommandLine;
using test::contains;
using test::runWith;

namespace {

/// A folder of its own for a test, removed with all that is in it.
class TemporaryFolder {
public:
    TemporaryFolder() { std::filesystem::create_directories(path_); }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    std::string fileWith(const std::string& text) const {
        std::ofstream(file("balls.csv")) << text;
        return file("balls.csv");
    }

private:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("ballpit_test_input_" + std::to_string(getpid()));
};

std::string messageOfReading(const std::string& text) {
    const TemporaryFolder folder;
    return test::messageOf<InputError>([&] { readSpheres(folder.fileWith(text)); });
}

constexpr const char* goodLine = "1,2,3,4,5,6,0.5,2,0.75";

}  // namespace

TEST_CASE("balls written to a file and read again are the same to the last bit") {
    const TemporaryFolder folder;
    Spheres spheres = makeGravityFall(100, 1).spheres;
    spheres.add({1.0f / 3.0f, -0.0f, 1e-40f}, {3.4e38f, -1e-45f, 0.1f}, 1e-30f, 3e38f, 1.0f / 3.0f,
                {0.1f, 0.2f, 0.3f});
    writeSpheres(folder.file("out.csv"), spheres);
    const Spheres again = readSpheres(folder.file("out.csv"));
    CHECK(test::bitsOf(again.positions) == test::bitsOf(spheres.positions));
    CHECK(test::bitsOf(again.velocities) == test::bitsOf(spheres.velocities));
    CHECK(test::bitsOf(again.radii) == test::bitsOf(spheres.radii));
    CHECK(test::bitsOf(again.masses) == test::bitsOf(spheres.masses));
    CHECK(test::bitsOf(again.restitutions) == test::bitsOf(spheres.restitutions));
    CHECK(test::bitsOf(again.colors) == test::bitsOf(spheres.colors));
    CHECK_FALSE(std::filesystem::exists(folder.file("out.csv.part")));
}

TEST_CASE("a file may have a header, blank lines, spaces, Windows line ends, and no colours") {
    const TemporaryFolder folder;
    const Spheres spheres = readSpheres(folder.fileWith(
        "x,y,z,vx,vy,vz,radius,mass,restitution\r\n\r\n 1, 2,3 ,4,5,6,0.5,2,0.75\r\n"
        "7,8,9,0,0,0,0.5,2,1,0.25,0.5,1"));
    REQUIRE(spheres.count() == 2);
    CHECK(spheres.positions[0] == Vec3{1, 2, 3});
    CHECK(spheres.velocities[0] == Vec3{4, 5, 6});
    CHECK(spheres.radii[0] == 0.5f);
    CHECK(spheres.masses[0] == 2.0f);
    CHECK(spheres.restitutions[0] == 0.75f);
    CHECK(spheres.colors[1] == Vec3{0.25f, 0.5f, 1});
}

TEST_CASE("a bad line of a file is refused by file, line number and rule") {
    struct Case {
        const char *line, *rule;
    };
    const std::vector<Case> cases{
        {"1,2,3", "3 fields: 9 are needed"},
        {"1,2,3,4,5,6,0.5,2,0.75,0.5", "10 fields: 9 are needed"},
        {"1,2,3,4,5,6,0.5,2,0.75,", "field 10 is '', not a number"},
        {"1,two,3,4,5,6,0.5,2,0.75", "field 2 is 'two', not a number"},
        {"1,2,3,4,5,6,0.5,2 kg,0.75", "field 8 is '2 kg', not a number"},
        {"1,2,3,4,5,6,0.5,2e99,0.75", "field 8 is '2e99', not a number"},
        {"nan,2,3,4,5,6,0.5,2,0.75", "position (nan, 2, 3): must be finite numbers in m"},
        {"1,2,3,4,inf,6,0.5,2,0.75", "velocity (4, inf, 6): must be finite numbers in m/s"},
        {"1,2,3,4,5,6,-0.5,2,0.75", "radius -0.5: must be a finite number of metres, 0 or more"},
        {"1,2,3,4,5,6,inf,2,0.75", "radius inf: must be a finite number of metres, 0 or more"},
        {"1,2,3,4,5,6,0.5,0,0.75", "mass 0: must be a finite number of kilograms above 0"},
        {"1,2,3,4,5,6,0.5,-2,0.75", "mass -2: must be a finite number of kilograms above 0"},
        {"1,2,3,4,5,6,0.5,2,1.5", "restitution 1.5: must lie between 0 (dead stop) and 1"},
        {"1,2,3,4,5,6,0.5,2,-0.1", "restitution -0.1: must lie between 0"},
        {"1,2,3,4,5,6,0.5,2,nan", "restitution nan: must lie between 0"}};
    for (const Case& bad : cases) {
        const std::string text = std::string("x,y,z\n") + goodLine + "\n" + bad.line + "\n";
        const std::string message = messageOfReading(text);
        CAPTURE(bad.line, message);
        CHECK(contains(message, "balls.csv:3: "));
        CHECK(contains(message, bad.rule));
    }
}

TEST_CASE("a file without balls, or no file at all, is refused by name") {
    CHECK(contains(messageOfReading(""), "balls.csv: no balls in it"));
    CHECK(contains(messageOfReading("x,y,z,vx\n\n"), "balls.csv: no balls in it"));
    CHECK(contains(test::messageOf<InputError>([] { readSpheres("no/such/file.csv"); }),
                   "no/such/file.csv: cannot be read"));
}

TEST_CASE("a path is writable if its folder exists and it is not a folder itself") {
    const TemporaryFolder folder;
    requireWritable(folder.file("new.csv"));
    requireWritable("new_in_the_working_folder.csv");
    CHECK(contains(
        test::messageOf<InputError>([&] { requireWritable(folder.file("missing/new.csv")); }),
        "does not exist"));
    std::filesystem::create_directory(folder.file("inner"));
    CHECK(contains(test::messageOf<InputError>([&] { requireWritable(folder.file("inner")); }),
                   "is a folder, not a file name"));
    CHECK_THROWS_AS(writeSpheres(folder.file("missing/new.csv"), {}), InputError);
    CHECK_FALSE(std::filesystem::exists(folder.file("new.csv")));
}

TEST_CASE("a folder without permission to write is refused") {
    if (geteuid() == 0) return;  // root may write anywhere
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("locked"));
    std::filesystem::permissions(folder.file("locked"), std::filesystem::perms::owner_read);
    CHECK(contains(test::messageOf<InputError>([&] { requireWritable(folder.file("locked/a")); }),
                   "cannot be written to"));
}

TEST_CASE("the options choose the scene and change what they name, and nothing else") {
    Options options;
    options.scene = "pile";
    options.count = 27;
    options.seed = 5;
    const Scene plain = sceneFor(options), made = makePile(27, 5);
    CHECK(stateHash(plain.spheres) == stateHash(made.spheres));
    CHECK(plain.gravity == made.gravity);
    CHECK(plain.cellSize == made.cellSize);

    options.dt = 0.001f;
    options.gravity = -1.5f;
    options.damping = 0.25f;
    options.restitution = 0.125f;
    options.cellSize = 3.0f;
    const Scene changed = sceneFor(options);
    CHECK(changed.dt == 0.001f);
    CHECK(changed.gravity == Vec3{0, -1.5f, 0});
    CHECK(changed.damping == 0.25f);
    CHECK(changed.cellSize == 3.0f);
    CHECK(changed.spheres.restitutions == std::vector<float>(27, 0.125f));
    CHECK(stateHash(changed.spheres) == stateHash(made.spheres));
}

TEST_CASE("a file of balls replaces the scene's balls") {
    const TemporaryFolder folder;
    Options options;
    options.spheresFile = folder.fileWith(goodLine);
    const Scene scene = sceneFor(options);
    REQUIRE(scene.spheres.count() == 1);
    CHECK(scene.spheres.positions[0] == Vec3{1, 2, 3});
}

TEST_CASE("an unknown scene is answered with the known ones") {
    Options options;
    options.scene = "gravity_fell";
    const std::string message = test::messageOf<InputError>([&] { sceneFor(options); });
    CHECK(contains(message, "scene 'gravity_fell'"));
    CHECK(contains(message, "gravity_fall, uniform"));
    CHECK_THROWS_AS(makeScene("pile", 0, 1), InputError);
    CHECK_THROWS_AS(makeScene("pile", -3, 1), InputError);
}

TEST_CASE("balls that do not fit without overlap are refused with a number that does") {
    const std::string message = test::messageOf<InputError>([] {
        nonOverlappingPositions(std::vector<float>(100, 0.5f), {{0, 0, 0}, {3, 3, 3}}, 1);
    });
    CHECK(contains(message, "count 100: these balls do not fit"));
}

TEST_CASE("the command line fills the options") {
    const CommandLine line = runWith("--count 42 --seed=7 --gravity -1.5 --device cpu --json");
    CHECK(line.exitCode == exitOk);
    CHECK(line.ran);
    CHECK(line.options.count == 42);
    CHECK(line.options.seed == 7);
    CHECK(line.options.gravity == -1.5f);
    CHECK(line.options.json);
    CHECK_FALSE(line.options.dt.has_value());
    CHECK(runWith("", [](const Options&) { return 7; }).exitCode == 7);
}

TEST_CASE("--help ends well and runs nothing") {
    const CommandLine line = runWith("--help");
    CHECK(line.exitCode == exitOk);
    CHECK_FALSE(line.ran);
    CHECK(contains(line.output, "--frames"));
}

TEST_CASE("an unknown option is answered with the nearest one") {
    for (const std::string words :
         {"--frmaes 3", "--frmaes=3", "--count 3 --frmaes 3", "--gravity -9.81 --frmaes 3"}) {
        const CommandLine line = runWith(words);
        CAPTURE(words);
        CHECK(line.exitCode == exitBadInput);
        CHECK_FALSE(line.ran);
        CHECK(line.errors == "error: unknown option --frmaes: did you mean --frames?\n");
    }
}

TEST_CASE("bad values on the command line run nothing and end with exit code 2") {
    for (const std::string words :
         {"--count", "--count 0", "--count -1", "--count many", "--count 2.5",
          "--count 99999999999", "--frames 0", "--iterations 0", "--dt 0", "--dt 2", "--dt nan",
          "--gravity inf", "--restitution 2", "--device tpu", "--save no/such/a", "--png no/such/b",
          "--out no/such/c", "stray"}) {
        const CommandLine line = runWith(words);
        CAPTURE(words, line.errors);
        CHECK(line.exitCode == exitBadInput);
        CHECK_FALSE(line.ran);
        CHECK(line.errors.rfind("error: ", 0) == 0);
        CHECK(std::count(line.errors.begin(), line.errors.end(), '\n') == 1);
    }
}

TEST_CASE("each kind of failure has its exit code and one line of its own") {
    const auto failing = [](auto error) {
        return runWith("", [=](const Options&) -> int { throw error; });
    };
    CHECK(failing(InputError("wrong")).exitCode == 2);
    CHECK(failing(NotFiniteError("blown up")).exitCode == 3);
    CHECK(failing(std::runtime_error("broken")).exitCode == 1);
    CHECK(failing(InputError("wrong")).errors == "error: wrong\n");
}
