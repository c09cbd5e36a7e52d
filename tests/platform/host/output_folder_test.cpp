#include <host/output_folder.h>

#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <memory>

#include <vp/error.h>

#include "temporary_files.h"

namespace fs = std::filesystem;
using platform::host::OutputFolder;
using platform::host::prepare_output_folder;

namespace {

using Names = std::vector<std::string>;

/// A run that writes files into the folder; it may be killed before it ends.
void write_files(const std::string& folder, const Names& names, bool killed = false) {
  const auto write = [&] {
    OutputFolder output(folder);
    for (const std::string& name : names) kit::write_file(output.add(name), name);
    if (killed) ::raise(SIGKILL);
  };
  if (!killed) return write();
  const pid_t child = ::fork();
  if (child == 0) write();
  ::waitpid(child, nullptr, 0);
}

std::string refusal(const std::string& folder) {
  try {
    OutputFolder output(folder);
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(output_folder, kit::TemporaryFolder)

BOOST_AUTO_TEST_CASE(a_folder_is_made_and_left_empty) {
  BOOST_TEST(prepare_output_folder(*this / "a/b"));
  BOOST_TEST(!prepare_output_folder(*this / "a/b"));
  BOOST_TEST(fs::is_empty(*this / "a/b"));
}

BOOST_AUTO_TEST_CASE(a_folder_that_cannot_be_is_refused) {
  kit::write_file(*this / "file", "x");
  for (const std::string& folder : {*this / "file", *this / "file/below", std::string("/proc/x")}) {
    BOOST_CHECK_THROW(prepare_output_folder(folder), vp::InputError);
    BOOST_TEST(refusal(folder).find("choose another with --output") != std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(nothing_is_left_where_nothing_was_written) {
  { OutputFolder output(*this / "new"); }
  BOOST_TEST(entries().empty());
  { OutputFolder output(path()); }
  BOOST_TEST(entries().empty());
}

BOOST_AUTO_TEST_CASE(files_of_an_earlier_run_are_replaced_as_a_whole) {
  for (const bool killed : {false, true}) {
    const kit::TemporaryFolder folder;
    write_files(folder.path(), {"a.png", "b.png", "result"}, killed);
    kit::write_file(folder / "mine.png", "mine");
    OutputFolder output(folder.path());
    BOOST_TEST(folder.entries().size() == 5u, "not before there is something new");
    kit::write_file(output.add("a.png"), "new");
    BOOST_TEST(folder.entries() == (Names{".markervp", "a.png", "mine.png"}));
  }
}

BOOST_AUTO_TEST_CASE(an_earlier_run_is_still_known_after_one_that_wrote_nothing) {
  write_files(path(), {"a", "b"});
  { OutputFolder output(path()); }
  BOOST_TEST(entries() == (Names{".markervp", "a", "b"}));
  write_files(path(), {"b"});
  BOOST_TEST(entries() == (Names{".markervp", "b"}));
}

BOOST_AUTO_TEST_CASE(links_folders_and_what_is_elsewhere_stay) {
  kit::write_file(*this / "elsewhere", "x");
  const std::string folder = *this / "folder";
  write_files(folder, {"link", "sub"});
  fs::remove(folder + "/link");
  fs::create_symlink("../elsewhere", folder + "/link");
  fs::remove(folder + "/sub");
  fs::create_directory(folder + "/sub");
  kit::write_file(folder + "/.markervp",
                  kit::read_file(folder + "/.markervp") + "../elsewhere\n.\n..\n\n");
  write_files(folder, {"new"});
  BOOST_TEST(fs::exists(*this / "elsewhere"));
  BOOST_TEST(fs::is_symlink(folder + "/link"));
  BOOST_TEST(fs::is_directory(folder + "/sub"));
}

BOOST_AUTO_TEST_CASE(one_at_a_time) {
  auto first = std::make_unique<OutputFolder>(*this / "out");
  const std::string who = "process " + std::to_string(::getpid()) + " on ";
  const std::string said = refusal(*this / "out");
  BOOST_TEST(said.find("another run or sweep writes into '" + (*this / "out") + "' (" + who) == 0u,
             said);
  first->add("a");
  BOOST_TEST(refusal(*this / "out") == said);
  first.reset();
  BOOST_TEST(refusal(*this / "out") == "");
}

/// A process that was forked meanwhile lets others in when it has said so.
BOOST_AUTO_TEST_CASE(children_can_leave_the_lock_to_their_parent) {
  auto output = std::make_unique<OutputFolder>(path());
  int ends[2];
  BOOST_REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    output->leave_to_parent();
    const bool told = ::write(ends[1], "x", 1) == 1;
    for (;;) ::sleep(told ? 60 : 1);
  }
  char told = 0;
  BOOST_TEST(::read(ends[0], &told, 1) == 1);
  BOOST_TEST(refusal(path()) != "");
  output.reset();
  BOOST_TEST(refusal(path()) == "");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  for (const int end : ends) ::close(end);
}

BOOST_AUTO_TEST_CASE(locks_of_bytes) {
  const std::string file = *this / "claims";
  platform::host::FileLock first, second;
  BOOST_TEST(first.take(file, 7, false));
  BOOST_TEST(!second.take(file, 7, false));
  BOOST_TEST(second.take(file, 8, false));
  first.close();
  BOOST_TEST(second.take(file, 7, true));
}

BOOST_AUTO_TEST_SUITE_END()
