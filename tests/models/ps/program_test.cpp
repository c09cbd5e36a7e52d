// Programs as plug-ins: loading, what can be wrong with them, and their static state.
#include <dlfcn.h>

#include <vp/error.h>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "bench.h"

namespace {

const std::string programs = MARKERVP_TEST_PROGRAMS "/";

struct Recorder : ps::TestBench {
  const hal_frame* next_frame(std::uint64_t) override { return nullptr; }
  bool publish(std::uint32_t, const void* data, std::size_t size, std::uint64_t) override {
    seen.resize(size / sizeof(int));
    std::memcpy(seen.data(), data, size);
    return true;
  }
  double option(std::uint32_t, const hal_option_info&) override { return 0; }
  std::vector<int> seen;
};

std::vector<int> run(ps::Program& program) {
  bench::Bench b;
  Recorder recorder;
  b.cpu.connect(recorder);
  b.cpu.load(program, bench::costs());
  sc_core::sc_start();
  b.cpu.check();
  BOOST_TEST(b.cpu.end_ps() == 10'000u);
  return recorder.seen;
}

std::string error_of(const std::string& path) {
  try {
    ps::Program::load(path);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return {};
}

const std::vector<int> fresh{5, 0, 0, 1, 17, 23, 19};

}  // namespace

BOOST_AUTO_TEST_SUITE(program)

BOOST_AUTO_TEST_CASE(a_plug_in_runs) {
  const auto program = ps::Program::load(programs + "counting.so");
  BOOST_TEST(std::string(program->name()) == "counting");
  BOOST_TEST(program->path().front() == '/');
  BOOST_TEST(run(*program) == fresh, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(static_state_is_fresh_in_every_run) {
  const auto program = ps::Program::load(programs + "counting.so");
  for (int i = 0; i < 3; ++i) BOOST_TEST(run(*program) == fresh, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(static_state_is_fresh_when_loaded_again_or_twice) {
  const auto first = ps::Program::load(programs + "counting.so");
  run(*first);
  const auto second = ps::Program::load(programs + "./counting.so");
  BOOST_TEST(run(*second) == fresh, boost::test_tools::per_element());
  BOOST_TEST(run(*first) == fresh, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(static_state_is_fresh_of_a_program_that_stays_loaded) {
  ps::Program::keep_loaded();
  for (int i = 0; i < 3; ++i) {
    const auto program = ps::Program::load(programs + "counting.so");
    BOOST_TEST(run(*program) == fresh, boost::test_tools::per_element());
  }
  void* const loaded = dlopen((programs + "counting.so").c_str(), RTLD_NOW | RTLD_NOLOAD);
  BOOST_TEST(loaded != nullptr);
  if (loaded) dlclose(loaded);
}

BOOST_AUTO_TEST_CASE(a_linked_program) {
  int calls = 0;
  const auto program = ps::Program::linked(bench::program([&] {
    hal_work(bench::step, 10);
    ++calls;
    return 0;
  }));
  BOOST_TEST(program->path().empty());
  run(*program);
  BOOST_TEST(calls == 1);
}

BOOST_AUTO_TEST_CASE(missing_file) {
  BOOST_TEST(error_of("/nowhere/hybrid.so") ==
             "cannot load program '/nowhere/hybrid.so': No such file or directory");
  BOOST_TEST(error_of("") == "cannot load program '': No such file or directory");
}

BOOST_AUTO_TEST_CASE(no_shared_object) {
  const auto path = std::filesystem::temp_directory_path() / "markervp_no_shared_object.so";
  std::ofstream(path) << "text";
  const std::string error = error_of(path);
  BOOST_TEST(error.find("cannot load program '" + path.string() + "': ") == 0u, error);
  std::filesystem::remove(path);
  BOOST_TEST(error_of("/tmp").find("cannot load program '/tmp': ") == 0u);
}

BOOST_AUTO_TEST_CASE(no_program) {
  const std::string path = programs + "no_program.so";
  BOOST_TEST(error_of(path) == "'" + path +
                                   "' is not a PS program: it has no symbol hal_program_info "
                                   "(define it as <hal/hal.h> declares it)");
}

BOOST_AUTO_TEST_CASE(wrong_abi) {
  const std::string path = programs + "wrong_abi.so";
  BOOST_TEST(error_of(path) == "program '" + path +
                                   "' was built for version 43 of the HAL, this is version 2: "
                                   "rebuild it");
}

BOOST_AUTO_TEST_CASE(incomplete) {
  const std::string path = programs + "incomplete.so";
  BOOST_TEST(error_of(path).find("has an incomplete hal_program_info") != std::string::npos);
  hal_program no_entry = bench::program([] { return 0; });
  no_entry.entry = nullptr;
  BOOST_CHECK_EXCEPTION(ps::Program::linked(no_entry), vp::InputError, [](const auto& error) {
    return std::string(error.what()).find("neither main() nor") != std::string::npos;
  });
}

/// What load() says of a description with one thing wrong.
template <class Change>
std::string error_of_changed(Change change) {
  hal_program changed = bench::program([] { return 0; });
  change(changed);
  try {
    ps::Program::linked(changed);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return {};
}

std::string error_of_options(const std::vector<hal_option_info>& options) {
  return error_of_changed([&](hal_program& program) {
    program.options = options.data();
    program.option_count = static_cast<std::uint32_t>(options.size());
  });
}

BOOST_AUTO_TEST_CASE(tables_that_cannot_be) {
  const auto says = [](const std::string& error, const std::string& part) {
    BOOST_TEST(error.find("the linked program " + part) == 0u, error);
  };
  says(error_of_changed([](hal_program& p) { p.work_count = 4'000'000'000; }),
       "claims 4000000000 units: at most 4096");
  says(error_of_changed([](hal_program& p) { p.functions = nullptr; }),
       "has an incomplete hal_program_info: it counts functions");
  says(error_of_changed([](hal_program& p) { p.work = reinterpret_cast<const char* const*>(16); }),
       "has a broken hal_program_info (segmentation fault: read of 0x00000010");
  static const char* const twice[] = {"a", "b", "a"};
  says(error_of_changed([](hal_program& p) {
         p.work = twice;
         p.work_count = 3;
       }),
       "has two units named 'a'");
  static const char* const unnamed[] = {"a", ""};
  says(error_of_changed([](hal_program& p) {
         p.functions = unnamed;
         p.function_count = 2;
       }),
       "has no name for function number 1");
  says(error_of_changed([](hal_program& p) { p.name = ""; }), "has an incomplete");
}

BOOST_AUTO_TEST_CASE(options_that_cannot_be) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::string range = "give finite numbers, the default in the range";
  BOOST_TEST(error_of_options({{"a", "", 1, 0, 2, ""}, {"a_2", "", 0, 0, 0, "d"}}) == "");
  BOOST_TEST(error_of_options({{"a", "no|yes", 1, 0, 1, ""}}) == "");
  BOOST_TEST(error_of_options({{"a", "file", 0, 0, 1, ""}}) == "");
  for (const auto& [option, part] : std::vector<std::pair<hal_option_info, std::string>>{
           {{"a", "", nan, 0, 1, ""}, range},
           {{"a", "", 0, nan, 1, ""}, range},
           {{"a", "", 0, 0, infinite, ""}, range},
           {{"a", "", 3, 0, 2, ""}, range},
           {{"a", "", 0, 2, 1, ""}, range},
           {{"a.b", "", 0, 0, 1, ""}, "letters, digits and _"},
           {{"opt", "", 0, 0, 1, ""}, "sw.opt"},
           {{"a", nullptr, 0, 0, 1, ""}, "without unit"},
           {{"a", "", 0, 0, 1, nullptr}, "without unit or documentation"},
           {{"a", "no|yes", 0, 0, 2, ""}, "names 2 values: its default is the place of one"},
           {{"a", "no|yes|maybe", 0.5, 0, 2, ""}, "its range 0 to 2"},
           {{"a", "no||yes", 0, 0, 2, ""}, "empty name"},
           {{"a", "file", 1, 0, 1, ""}, "names a file: its default is 0, its range 0 to 1"},
           {{"a", "file", 0, 0, 2, ""}, "names a file"},
           {{nullptr, "", 0, 0, 1, ""}, "no name for option number 0"}}) {
    const std::string error = error_of_options({option});
    BOOST_TEST(error.find(part) != std::string::npos, error);
  }
  const std::string twice = error_of_options({{"a", "", 0, 0, 1, ""}, {"a", "", 0, 0, 1, ""}});
  BOOST_TEST(twice.find("has two options named 'a': rename one") != std::string::npos, twice);
}

BOOST_AUTO_TEST_CASE(unresolved_symbol) {
  const std::string error = error_of(programs + "unresolved.so");
  BOOST_TEST(error.find("nobody_has_this") != std::string::npos, error);
}

BOOST_AUTO_TEST_SUITE_END()
