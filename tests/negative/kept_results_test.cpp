// What is kept of a run that cannot go on, or shares its folder.
#include <sys/mount.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>

#include "command_line.h"

using namespace negative;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Ends by itself at some time, should the test be killed.
const Words long_run{"run", "z1.0", "yaw30", "--repeat", "1000", "--no-report"};

/// A disk of a few MB; the test of it needs root.
class SmallDisk {
 public:
  explicit SmallDisk(const std::string& folder) : folder_(folder) {
    fs::create_directory(folder);
    mounted_ = ::mount("none", folder.c_str(), "tmpfs", 0, "size=3m") == 0;
    if (!mounted_) BOOST_TEST_MESSAGE("no small disk to test with: " << std::strerror(errno));
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool mounted() const { return mounted_; }

 private:
  std::string folder_;
  bool mounted_ = false;
};

Words names_in(const std::string& folder) {
  Words names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void await_frames(const kit::ChildProcess& run) {
  while (!run.ended() && !contains(run.out(), " 3/2000]"))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

/// Checks that the folder has the result of a part of the run, its pictures if `pictures`, and
/// nothing else. Returns the number of frames.
std::size_t check_kept(const std::string& folder, const std::string& incomplete,
                       bool pictures = true) {
  const Json result = Json::parse(kit::read_file(folder + "/result.json"));
  BOOST_TEST(result["incomplete"] == incomplete);
  const std::size_t frames = result["frames"].size();
  BOOST_TEST(result["summary"]["frames"] == frames);
  std::size_t found = 0;
  for (const std::string& name : names_in(folder)) {
    const bool picture = name.size() > 4 && name.substr(name.size() - 4) == ".png";
    found += picture ? 1 : 0;
    BOOST_TEST((picture || name == ".markervp" || name == "result.json"), name << " is left over");
  }
  if (pictures) BOOST_TEST((found == frames || found == frames + 1));
  return frames;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(kept_results, CommandLine)

BOOST_AUTO_TEST_CASE(nobody_reads_what_it_prints) {
  const kit::Outcome outcome =
      shell("\"$markervp\" run z1.0 --repeat 1000 --no-report | head -1; exit ${PIPESTATUS[0]}");
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"cannot write 'standard output': Broken pipe"});
  BOOST_TEST(contains(outcome.out, "1/1000"), outcome.out);
  const std::size_t frames = check_kept(*this / "out", "stopped by an error");
  BOOST_TEST(frames >= 1u);
  BOOST_TEST(frames < 1000u);
}

BOOST_AUTO_TEST_CASE(a_file_grows_too_large) {
  // 100 KiB: some tens of frames.
  const kit::Outcome outcome =
      shell("ulimit -f 100; exec \"$markervp\" run z1.0 --repeat 1000 --no-pictures --no-report");
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"cannot write 'out/result.json': File too large"});
  const std::size_t frames = check_kept(*this / "out", "stopped by an error", false);
  BOOST_TEST(frames >= 5u);
  BOOST_TEST(frames < 1000u);
}

BOOST_AUTO_TEST_CASE(an_input_goes_bad_in_the_middle) {
  write_image("grey.pgm");
  // The pipe has no room for the reports of all frames before the image is damaged.
  const kit::Outcome outcome = shell(
      "\"$markervp\" run $(yes z1.0 | head -200) grey.pgm --no-pictures --no-report | "
      "{ read -r first; printf 'P5 640 480 255\\n...' > grey.pgm; cat > rest; }; "
      "exit ${PIPESTATUS[0]}");
  BOOST_TEST(outcome.exit_code == 2);
  BOOST_TEST(contains(outcome.err, "'grey.pgm' is truncated"), outcome.err);
  BOOST_TEST(check_kept(*this / "out", "stopped by an error", false) == 200u);
}

BOOST_AUTO_TEST_CASE(the_disk_becomes_full) {
  const SmallDisk disk(*this / "disk");
  if (!disk.mounted()) return;
  for (const bool pictures : {true, false}) {
    Words arguments = long_run;
    arguments.insert(arguments.end(), {"--output", pictures ? "disk/pictures" : "disk/plain"});
    if (!pictures) arguments.emplace_back("--no-pictures");
    const kit::Outcome outcome = start(arguments);
    BOOST_TEST(outcome.exit_code == 2);
    check_one_line(outcome.err, {"No space left on device; make room"});
    const std::size_t frames = check_kept(
        arguments.back() == "--no-pictures" ? *this / "disk/plain" : *this / "disk/pictures",
        "stopped by an error", pictures);
    BOOST_TEST(frames >= 2u);
    BOOST_TEST(frames < 2000u);
    fs::remove_all(*this / (pictures ? "disk/pictures" : "disk/plain"));
  }
}

BOOST_AUTO_TEST_CASE(other_outputs_do_not_keep_a_result_from_being_written) {
  const SmallDisk disk(*this / "disk");
  if (!disk.mounted()) return;
  const kit::Outcome outcome = start({"run", "z1.0", "--quiet", "--trace", "disk/a.vcd"});
  BOOST_TEST(outcome.exit_code == 2);
  check_one_line(outcome.err, {"cannot write 'disk/a.vcd': No space left on device"});
  BOOST_TEST(names_in(*this / "disk").empty());
}

BOOST_AUTO_TEST_CASE(two_runs_into_one_folder) {
  kit::ChildProcess first(MARKERVP_EXECUTABLE, long_run, path());
  await_frames(first);
  const kit::Outcome second = start({"run", "roll30"});
  BOOST_TEST(second.exit_code == 2);
  BOOST_TEST(second.out == "");
  check_one_line(second.err, {"another run or sweep writes into 'out' (process " +
                                  std::to_string(first.pid()) + " on ",
                              "choose another folder with --output"});
  first.send(SIGTERM);
  BOOST_TEST(first.wait().exit_code == 130);
  check_kept(*this / "out", "interrupted");
}

BOOST_AUTO_TEST_CASE(a_killed_run_leaves_no_part_file_and_the_next_one_replaces_it) {
  Words arguments = long_run;
  arguments.insert(arguments.end(),
                   {"--trace", "a.vcd", "--timeline", "t.json", "--log-bus", "bus.log"});
  kit::ChildProcess run(MARKERVP_EXECUTABLE, arguments, path());
  await_frames(run);
  run.send(SIGKILL);
  run.wait();
  BOOST_TEST(entries() == Words{"out"});
  for (const std::string& name : names_in(*this / "out"))
    BOOST_TEST((name == ".markervp" || contains(name, ".png")), name << " is left over");
  kit::write_file(*this / "out/0007_mine.png", "mine");
  BOOST_TEST(start({"run", "roll30", "--quiet", "--no-report"}).exit_code == 0);
  BOOST_TEST(names_in(*this / "out") ==
             (Words{".markervp", "0000_roll30.png", "0007_mine.png", "result.json"}));
}

BOOST_AUTO_TEST_CASE(an_earlier_run_is_replaced_as_a_whole) {
  BOOST_TEST(start({"run", "z1.0", "roll30", "demo", "--quiet"}).exit_code == 0);
  BOOST_TEST(start({"run", "yaw30", "--quiet", "--no-report"}).exit_code == 0);
  BOOST_TEST(names_in(*this / "out") == (Words{".markervp", "0000_yaw30.png", "result.json"}));
  BOOST_TEST(start({"run", "demo", "--quiet", "--no-report", "--no-pictures"}).exit_code == 0);
  BOOST_TEST(names_in(*this / "out") == (Words{".markervp", "result.json"}));
}

BOOST_AUTO_TEST_SUITE_END()
