// The scripts, run in a copy of scripts/ among stand-ins for the tools of the machine.
#include <sys/wait.h>

#include <cstdio>

#include "catch2.hpp"
#include "temporary_folder.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code;
  std::string output;  // stdout and stderr
};

class Machine {
 public:
  /// With the tools of every system; what else there is, each test adds.
  Machine() {
    fs::create_directories(folder_.path("bin"));
    fs::create_directories(folder_.path("tree/scenes"));
    fs::copy(fs::path(CAUSTICL_SOURCE_DIR) / "scripts", folder_.path("tree/scripts"),
             fs::copy_options::recursive);
    for (const std::string tool : {"bash", "env", "dirname", "grep", "mkdir", "rm", "cat", "chmod"}) {
      for (const std::string place : {"/usr/bin/", "/bin/"}) {
        if (!fs::exists(place + tool) || fs::exists(folder_.path("bin/" + tool))) continue;
        fs::create_symlink(place + tool, folder_.path("bin/" + tool));
      }
    }
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  /// A tool that runs these lines of bash, after it has noted how it was called.
  void add_tool(const std::string& name, const std::string& lines) const {
    const std::string file =
        folder_.write("bin/" + name, "#!" + path("bin/bash") + "\necho \"" + name + " $*\" >> " +
                                         path("calls") + "\n" + lines + "\n");
    fs::permissions(file, fs::perms::owner_all);
  }

  void add_debian(const std::string& installed, int user) const {
    std::string lines;
    for (std::size_t begin = 0; begin < installed.size();) {
      const auto end = std::min(installed.find(' ', begin), installed.size());
      lines += "printf 'installed:" + installed.substr(begin, end - begin) + " '\n";
      begin = end + 1;
    }
    add_tool("dpkg-query", lines + "printf 'not-installed:libcli11-dev '; exit 1");  // 1: some are not known
    add_tool("apt-get", "");
    add_tool("id", "echo " + std::to_string(user));
  }

  /// CMake and ninja that make a causticl which prints its arguments.
  void add_build() const {
    add_tool("cmake",
             "mkdir -p $4\n{ echo CMAKE_HOME_DIRECTORY:INTERNAL=$2; for o in \"${@:7}\"; do o=${o#-D};"
             " echo \"${o%%=*}:STRING=${o#*=}\"; done; } > $4/CMakeCache.txt\necho > $4/build.ninja");
    add_tool("ninja",
             "if [ -f $2/causticl ]; then echo 'ninja: Entering directory x'; echo 'ninja: no work to do.'; "
             "exit; fi\n"
             "echo '[1/1] Linking'\nprintf '#!" +
                 path("bin/bash") + "\\necho \"$@\"\\n' > $2/causticl\nchmod +x $2/causticl");
  }

  Outcome run(const std::string& command) const {
    fs::remove(path("calls"));
    const std::string line = "cd " + path("tree") + " && env -i PATH=" + path("bin") + " " +
                             path("bin/bash") + " " + command + " 2>&1 </dev/null";
    std::FILE* pipe = popen(line.c_str(), "r");
    REQUIRE(pipe);
    Outcome outcome{0, ""};
    for (int c; (c = std::fgetc(pipe)) != EOF;) outcome.output += static_cast<char>(c);
    const int status = pclose(pipe);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
  }

  std::string calls() const {
    std::ifstream in(path("calls"));
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  TemporaryFolder folder_;
};

const std::string all_but_cli11 =
    "g++ cmake ninja-build pkg-config ocl-icd-opencl-dev opencl-c-headers opencl-clhpp-headers "
    "pocl-opencl-icd "
    "nlohmann-json3-dev libstb-dev libopenexr-dev libxxhash-dev";
const std::string everything = all_but_cli11 + " libcli11-dev catch2 clang-format python3-jsonschema";

}  // namespace

TEST_CASE("Set-up is silent where nothing is missing") {
  const Machine machine;
  machine.add_debian(everything, 1000);
  const Outcome outcome = machine.run("scripts/setup.sh");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.output == "");
  CHECK(machine.calls().find("apt-get") == std::string::npos);
}

TEST_CASE("Set-up installs just what is missing") {
  const Machine machine;
  machine.add_debian(all_but_cli11, 0);
  const Outcome outcome = machine.run("scripts/setup.sh");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.output ==
        "Installing from Debian's packages (this can take minutes): libcli11-dev catch2 clang-format "
        "python3-jsonschema\n");
  CHECK(machine.calls().find(
            "install -y --no-install-recommends libcli11-dev catch2 clang-format python3-jsonschema\n") !=
        std::string::npos);
  machine.add_tool("apt-get", "[[ $* != *install* ]]");
  const Outcome failed = machine.run("scripts/setup.sh");
  CHECK(failed.exit_code == 1);
  CHECK(failed.output.find("error: the packages could not be installed: libcli11-dev") != std::string::npos);
}

TEST_CASE("Set-up by another user goes through sudo, or says what to install") {
  const Machine machine;
  machine.add_debian(all_but_cli11, 1000);
  const Outcome refused = machine.run("scripts/build.sh");
  CHECK(refused.exit_code == 1);
  CHECK(refused.output ==
        "error: packages are missing and this user cannot install them. As root, run:\n"
        "  apt-get install libcli11-dev\n");
  machine.add_tool("sudo", "[ $1 = -n ] && shift; exec \"$@\"");
  machine.add_tool("true", "");
  machine.add_build();
  CHECK(machine.run("scripts/build.sh").exit_code == 0);
  CHECK(machine.calls().find("sudo env DEBIAN_FRONTEND=noninteractive") != std::string::npos);
  CHECK(machine.calls().find("install -y --no-install-recommends libcli11-dev\n") != std::string::npos);
}

TEST_CASE("On another system the scripts say what is needed, and build where it is there") {
  const Machine machine;
  const Outcome refused = machine.run("scripts/build.sh");
  CHECK(refused.exit_code == 1);
  CHECK(refused.output.find("error: not found: c++ cmake ninja pkg-config. This is no Debian system") == 0);
  machine.add_build();
  machine.add_tool("c++", "");
  machine.add_tool("pkg-config", "");
  CHECK(machine.run("scripts/build.sh").exit_code == 0);
}

TEST_CASE("The build is configured once, and again where an option or the place changes") {
  const Machine machine;
  machine.add_debian(everything, 0);
  machine.add_build();
  const auto configured = [&] { return machine.calls().find("cmake -S") != std::string::npos; };
  CHECK(machine.run("scripts/build.sh").output == "[1/1] Linking\n");
  CHECK(configured());
  CHECK(machine.run("scripts/build.sh").output == "");
  CHECK(!configured());

  fs::copy(machine.path("tree"), machine.path("copy"), fs::copy_options::recursive);
  CHECK(machine.run("../copy/scripts/build.sh").output == "[1/1] Linking\n");
  CHECK(configured());

  machine.add_tool("cmake", "echo 'CMake Error: no compiler' >&2; exit 1");
  fs::remove_all(machine.path("tree/build"));
  const Outcome failed = machine.run("scripts/build.sh");
  CHECK(failed.exit_code == 1);
  CHECK(failed.output == "error: CMake could not configure the build:\nCMake Error: no compiler\n");
}

TEST_CASE("A failed build ends the script") {
  const Machine machine;
  machine.add_debian(everything, 0);
  machine.add_build();
  machine.add_tool("ninja", "echo 'FAILED: x'; exit 1");
  const Outcome failed = machine.run("scripts/render.sh a.json");
  CHECK(failed.exit_code == 1);
  CHECK(failed.output == "FAILED: x\nerror: the build failed\n");
}

TEST_CASE("render.sh passes its arguments on, and has a scene and an output of its own") {
  const Machine machine;
  machine.add_debian(everything, 0);
  machine.add_build();
  machine.run("scripts/build.sh");
  const std::string scene = machine.path("tree/scenes/glass_caustic.json"), out = machine.path("tree/out/");
  const auto arguments = [&](const std::string& given) {
    return machine.run("scripts/render.sh " + given).output;
  };
  CHECK(arguments("") == "render " + scene + " -o " + out + "glass_caustic.png\n");
  CHECK(fs::is_directory(out));
  CHECK(arguments("--passes 3") == "render " + scene + " -o " + out + "glass_caustic.png --passes 3\n");
  CHECK(arguments("--passes 3 -o a.exr") == "render " + scene + " --passes 3 -o a.exr\n");
  CHECK(arguments("--output=a.exr") == "render " + scene + " --output=a.exr\n");
  CHECK(arguments("my.json") == "render my.json\n");
  CHECK(arguments("'my scene.json' --passes 3") == "render my scene.json --passes 3\n");
}

TEST_CASE("test.sh refuses what it does not know") {
  const Machine machine;
  const Outcome outcome = machine.run("scripts/test.sh --lang");
  CHECK(outcome.exit_code == 1);
  CHECK(outcome.output == "error: unknown argument --lang; expected --long, --sanitize or --debug\n");
}

}  // namespace causticl
