// Shared objects of users: loading them, and calls that end or damage the process.
#include <vp/foreign_object.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <string>

#include "temporary_files.h"

namespace {

const std::string path = MARKERVP_TEST_OBJECT;

void* loaded() {
  static void* const handle = [] {
    void* object = vp::load_object(vp::design_object, path);
    vp::keep_object(vp::design_object, path, object);
    return object;
  }();
  return handle;
}

void call(const char* function) {
  reinterpret_cast<void (*)()>(dlsym(loaded(), function))();
}

/// How a call ended; empty: it returned.
std::string end_of(const char* function) {
  try {
    vp::call_objects([&] { call(function); });
  } catch (const vp::ObjectEnd& end) {
    return end.what();
  }
  return {};
}

}  // namespace

BOOST_AUTO_TEST_SUITE(foreign_object)

BOOST_AUTO_TEST_CASE(calls_that_end_the_process_are_errors) {
  const std::string name = "design '" + path + "': ";
  BOOST_TEST(end_of("do_nothing") == "");
  for (int i = 0; i < 3; ++i) {
    BOOST_TEST(end_of("write_to_null") ==
               name + "segmentation fault: write to 0x00000000 (a null pointer)");
    BOOST_TEST(end_of("end_the_process") == name + "it called exit(0)");
  }
}

BOOST_AUTO_TEST_CASE(the_innermost_call_ends) {
  std::string inner, outer;
  try {
    vp::call_objects([&] {
      inner = end_of("end_the_process");
      call("write_to_null");
    });
  } catch (const vp::ObjectEnd& end) {
    outer = end.what();
  }
  BOOST_TEST(inner.find("exit(0)") != std::string::npos, inner);
  BOOST_TEST(outer.find("segmentation fault") != std::string::npos, outer);
}

BOOST_AUTO_TEST_CASE(exceptions_pass) {
  BOOST_CHECK_EXCEPTION(
      vp::call_objects([] { call("throw_an_error"); }), std::runtime_error,
      [](const auto& error) { return std::string(error.what()) == "thrown by an object"; });
}

BOOST_AUTO_TEST_CASE(code_is_known_by_its_address) {
  const auto place = [](const void* address) {
    return vp::foreign_object_at(reinterpret_cast<std::uintptr_t>(address));
  };
  BOOST_TEST_REQUIRE(place(dlsym(loaded(), "do_nothing")) != nullptr);
  BOOST_TEST(place(dlsym(loaded(), "do_nothing")) == "design '" + path + "'");
  BOOST_TEST(place(reinterpret_cast<const void*>(&end_of)) == nullptr);
}

BOOST_AUTO_TEST_CASE(what_touches_an_object_is_told_how_it_stopped) {
  BOOST_TEST(vp::stopped_by([] {}) == "");
  BOOST_TEST(vp::stopped_by([] { call("end_the_process"); }) == "it called exit(0)");
  BOOST_TEST(vp::stopped_by([] { call("throw_an_error"); }) ==
             "it threw an exception: thrown by an object");
}

#if !defined(__SANITIZE_ADDRESS__)
BOOST_AUTO_TEST_CASE(memory_that_an_object_damaged_ends_the_process_with_a_message) {
  loaded();
  const kit::TemporaryFolder folder;
  const pid_t process = ::fork();
  if (process == 0) {
    ::dup2(::open((folder / "err").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    vp::call_objects([] {
      struct {
        std::uintptr_t given = 0;
        void (*volatile own)() = [] {};
      } memory;
      reinterpret_cast<void (*)(std::uintptr_t*)>(dlsym(loaded(), "damage"))(&memory.given);
      memory.own();
    });
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(process, &status, 0);
  BOOST_TEST_REQUIRE(WIFEXITED(status));
  BOOST_TEST(WEXITSTATUS(status) == 3);
  BOOST_TEST(kit::read_file(folder / "err") ==
             "markervp: the platform's own code failed while design '" + path +
                 "' is loaded: it wrote where it must not, or this is a bug of markervp: run "
                 "without it to see\n");
}
#endif

BOOST_AUTO_TEST_CASE(files_that_are_no_objects) {
  const auto refusal = [](const std::string& file) {
    try {
      vp::load_object(vp::rtl_object, file);
    } catch (const vp::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  BOOST_TEST(refusal("/nowhere/x.so") ==
             "cannot load RTL '/nowhere/x.so': No such file or directory");
  BOOST_TEST(refusal("/tmp") ==
             "cannot load RTL '/tmp': Is a directory; name the shared object in it");
  BOOST_TEST(refusal("/dev/null") ==
             "cannot load RTL '/dev/null': it is a pipe or a device: name a file");
}

BOOST_AUTO_TEST_SUITE_END()
