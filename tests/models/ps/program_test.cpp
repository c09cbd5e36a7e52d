// Programs as plug-ins: loading, what can be wrong with them, and their static state.
#include <vp/error.h>
#include <boost/test/unit_test.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "bench.h"

namespace {

const std::string programs = MARKERVP_TEST_PROGRAMS "/";

struct Recorder : ps::TestBench {
  const hal_frame* next_frame(std::uint64_t) override { return nullptr; }
  void publish(std::uint32_t, const void* data, std::size_t size, std::uint64_t) override {
    seen.resize(size / sizeof(int));
    std::memcpy(seen.data(), data, size);
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
                                   "' was built for version 42 of the HAL, this is version 1: "
                                   "rebuild it");
}

BOOST_AUTO_TEST_CASE(incomplete) {
  const std::string path = programs + "incomplete.so";
  BOOST_TEST(error_of(path).find("has an incomplete hal_program_info") != std::string::npos);
  hal_program no_entry = bench::program([] { return 0; });
  no_entry.entry = nullptr;
  BOOST_CHECK_THROW(ps::Program::linked(no_entry), vp::InputError);
}

BOOST_AUTO_TEST_CASE(unresolved_symbol) {
  const std::string error = error_of(programs + "unresolved.so");
  BOOST_TEST(error.find("nobody_has_this") != std::string::npos, error);
}

BOOST_AUTO_TEST_SUITE_END()
