// RTL and designs from shared objects that cannot be loaded, and that end or damage the process.
#include <boost/test/unit_test.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "command_line.h"

using namespace negative;

namespace {

struct Objects : CommandLine {
  // What was left where it stood has no owner any more: on purpose.
  Objects() { ::setenv("LSAN_OPTIONS", "detect_leaks=0", 1); }
  ~Objects() {
    ::unsetenv("LSAN_OPTIONS");
    ::unsetenv("HOSTILE");
  }

  static std::string in_place(const std::string& file) {
    return "pl.fidelity.frame_status=" + file;
  }

  kit::Outcome run(const std::string& way, const Words& more = {}) const {
    ::setenv("HOSTILE", way.c_str(), 1);
    std::filesystem::remove_all(*this / "out");
    Words arguments{
        "run", "z1.0", "z1.5", "--output", "out", "--set", in_place(MARKERVP_HOSTILE_RTL)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments);
  }

  /// Exit code 3, and a message as the last line.
  static void check_ended(const kit::Outcome& outcome, const Words& parts) {
    BOOST_TEST(outcome.signal == 0);
    BOOST_TEST(outcome.exit_code == 3, outcome.out << outcome.err);
    const std::string text = outcome.err.substr(0, outcome.err.find_last_not_of('\n') + 1);
    const std::string last = text.substr(text.rfind('\n') + 1);
    BOOST_TEST(last.find("markervp: ") == 0u, outcome.err);
    for (const std::string& part : parts) BOOST_TEST(contains(last, part), part << ": " << last);
  }

  /// In the second frame, or behind it; finished ones are kept.
  void ends(const std::string& way, const Words& parts, bool behind = false) const {
    BOOST_TEST_CONTEXT(way) {
      check_ended(run("eval:" + way), parts);
      const auto result = nlohmann::json::parse(kit::read_file(*this / "out/result.json"));
      BOOST_TEST(result["incomplete"] == "stopped by an error");
      BOOST_TEST(result["frames"].size() >= 1u);
      BOOST_TEST(result["frames"].size() <= (behind ? 2u : 1u));
    }
  }
};

const std::string name = std::string("RTL '") + MARKERVP_HOSTILE_RTL + "': ";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(objects, Objects)

BOOST_AUTO_TEST_CASE(rtl_that_behaves) {
  BOOST_TEST(run("").exit_code == 0);
  BOOST_TEST(run("eval:harmless").exit_code == 0);
}

BOOST_AUTO_TEST_CASE(files_that_are_no_objects) {
  kit::write_file(*this / "text.so", "no object");
  kit::write_file(*this / "empty.so", "");
  std::filesystem::create_directory(*this / "folder.so");
  const std::size_t size = std::filesystem::file_size(MARKERVP_HOSTILE_RTL);
  kit::write_part(MARKERVP_HOSTILE_RTL, *this / "short.so", 100);
  kit::write_part(MARKERVP_HOSTILE_RTL, *this / "half.so", size / 4);
  std::string other = kit::read_file(MARKERVP_HOSTILE_RTL);
  other[18] = 40;  // e_machine: ARM
  kit::write_file(*this / "arm.so", other);
  for (const auto& [file, problem] : std::vector<std::pair<std::string, std::string>>{
           {"missing.so", "No such file"},
           {"text.so", "no shared object"},
           {"empty.so", "no shared object"},
           {"folder.so", "Is a directory"},
           {"short.so", "truncated"},
           {"half.so", "truncated"},
           {"arm.so", "for another machine, ARM"},
           {MARKERVP_UNRESOLVED, "nothing defines 'nothing_has_this'"}}) {
    run_refuses({"--set", in_place(file)}, {"cannot load RTL '" + file + "': ", problem});
    run_refuses({"--design", file}, {"cannot load design '", file + "': ", problem});
  }
}

BOOST_AUTO_TEST_CASE(objects_of_another_kind) {
  run_refuses({"--design", MARKERVP_HOSTILE_RTL}, {"is not a design", "markervp_design"});
  run_refuses({"--set", in_place(MARKERVP_CRASHING)}, {"is not RTL", "markervp_add_rtl()"});
  run_refuses({"--set", in_place(MARKERVP_OLD_RTL)}, {"has interface 3", "build it with"});
}

BOOST_AUTO_TEST_CASE(constructors_and_descriptions) {
  const std::string where = "in the constructor of a static object";
  for (const auto& [way, problem] : std::vector<std::pair<std::string, std::string>>{
           {"exit", "it called exit(0)"},
           {"_exit", "it called _exit(0)"},
           {"abort", "it called abort()"},
           {"execl", "it called execl()"},
           {"overflow", "stack overflow"},
           {"fault", "segmentation fault: write to 0x00000000"}}) {
    BOOST_TEST_CONTEXT(way) {
      check_ended(run("constructor:" + way), {name, problem, where});
      check_ended(run("descriptor:" + way), {problem});
      check_ended(run("create:" + way), {name, problem});
    }
  }
  // Every command that loads it.
  ::setenv("HOSTILE", "constructor:exit", 1);
  const Words set{"--set", in_place(MARKERVP_HOSTILE_RTL)};
  check_ended(start({"config", set[0], set[1]}), {name, where});
  check_ended(start({"map", set[0], set[1]}), {name, where});
  check_ended(start({"rtl", "check", "frame_status", "--rtl", MARKERVP_HOSTILE_RTL, "z1.0"}),
              {name, where});
  check_ended(start({"run", "--design", MARKERVP_HOSTILE_RTL}), {"design '", where});
}

BOOST_AUTO_TEST_CASE(evaluations_that_end_or_damage_the_process) {
  const std::string moment = ", in frame 2";
  ends("exit", {name, "it called exit(0)", "eval(", moment});
  ends("_exit", {name, "it called _exit(0)", moment});
  ends("quick_exit", {name, "it called quick_exit(0)", moment});
  ends("abort", {name, "it called abort()", moment});
  ends("terminate", {name, "it called std::terminate()", moment});
  ends("fault", {name, "segmentation fault: write to 0x00000000 (a null pointer)", moment});
  for (const std::string way : {"blocked", "blocked_thread"})
    ends(way, {name, "segmentation fault: write to 0x00000000", moment});
  ends("division", {name, "arithmetic trap", moment});
  ends("illegal", {name, "illegal instruction", moment});
  ends("fork", {name, "it called fork()", moment});
  ends("overflow", {name, "stack overflow", moment});
#if defined(__x86_64__)
  ends("breakpoint", {name, "breakpoint instruction", moment});
#endif
  ends("kill", {name, "it called kill()", moment});
  ends("raise", {name, "it called raise()", moment});
  ends("execl", {name, "it called execl()", moment});
  ends("execve", {name, "it called execve()", moment});
  ends("syscall", {name, "it called syscall()", moment});
  ends("error", {"no more"});
  ends("throw", {});
}

BOOST_AUTO_TEST_CASE(threads_of_an_object) {
  const std::string where = "in a thread of its own";
  ends("thread", {name, "it called exit(0)", where}, true);
  ends("faulty_thread", {name, "segmentation fault", where}, true);
}

// What the C library calls inside itself.
BOOST_AUTO_TEST_CASE(ends_that_come_from_the_library) {
  check_ended(run("eval:errx"), {"ended the process"});
}

BOOST_AUTO_TEST_CASE(destructors) {
  const std::string where = "in the destructor of a static object";
  check_ended(run("destructor:_exit"), {name, "it called _exit(0)", where});
  check_ended(run("destructor:abort"), {name, "it called abort()", where});
  BOOST_TEST(std::filesystem::exists(*this / "out/result.json"));
}

BOOST_AUTO_TEST_SUITE_END()
