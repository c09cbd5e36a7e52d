#include <vp/text.h>
#include <boost/test/unit_test.hpp>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "cli_kit.h"

using namespace cli_test;

namespace {

std::string output_of(const std::string& command) {
  const auto close = [](std::FILE* pipe) { ::pclose(pipe); };
  const std::unique_ptr<std::FILE, decltype(close)> pipe(::popen(command.c_str(), "r"), close);
  std::string text;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
    text += static_cast<char>(c);
  return text;
}

struct Completion : Terminal {
  /// The script, and a stand-in for the program that lists two scenes.
  std::string script(const std::string& shell) {
    BOOST_TEST(run({"completion", shell}) == 0);
    kit::write_file(folder / shell, out);
    kit::write_file(folder / "markervp", "#!/bin/sh\nprintf 'demo\\nz1.0\\n'\n");
    std::filesystem::permissions(folder / "markervp", std::filesystem::perms::owner_all);
    return folder / shell;
  }

  /// What bash offers for the last of `words`.
  std::string offered(const std::vector<std::string>& words) {
    std::string command =
        "cd '" + folder.path() + "' && bash -c 'source " + script("bash") + "; compopt() { :; }; ";
    command += "PATH=.:$PATH; COMP_WORDS=(" + vp::join(words, " ") + "); ";
    command += "COMP_CWORD=" + std::to_string(words.size() - 1) +
               "; _markervp; printf \"%s \" \"${COMPREPLY[@]}\"'";
    return output_of(command);
  }
};

}  // namespace

BOOST_FIXTURE_TEST_SUITE(completion, Completion)

BOOST_AUTO_TEST_CASE(bash_offers_commands_options_values_and_scenes) {
  BOOST_TEST(
      offered({"markervp", "\"\""}) ==
      "run history debug faults designs config map import report devices clocks power rtl trace "
      "sweep explore metrics pareto sensitivity compare scenes poses validate compare-detectors "
      "completion --help "
      "--version ");
  BOOST_TEST(offered({"markervp", "co"}) == "config compare compare-detectors completion ");
  BOOST_TEST(offered({"markervp", "run", "--trace-"}) ==
             "--trace-window --trace-filter --trace-level --trace-clocks --trace-trigger "
             "--trace-before --trace-frame --trace-buffer ");
  BOOST_TEST(offered({"markervp", "trace", "c"}) == "check cut convert ");
  BOOST_TEST(offered({"markervp", "run", "--fit", "\"\""}) == "crop scale ");
  BOOST_TEST(offered({"markervp", "run", "z1"}) == "z1.0 ");
  BOOST_TEST(offered({"markervp", "run", "demo", "--repeat", "\"\""}) == " ",
             "numbers are not offered");
  BOOST_TEST(offered({"markervp", "completion", "b"}) == "bash ");
  BOOST_TEST(contains(offered({"markervp", "scenes", "\"\""}), "roll "));
  BOOST_TEST(contains(offered({"markervp", "config", "--config", "\"\""}), "bash "),
             "files of the folder");
}

BOOST_AUTO_TEST_CASE(bash_accepts_the_script) {
  BOOST_TEST(std::system(("bash -n '" + script("bash") + "'").c_str()) == 0);
}

BOOST_AUTO_TEST_CASE(the_script_knows_every_option) {
  const std::string text = kit::read_file(script("bash"));
  for (const char* option :
       {"output", "trace-window", "camera", "fit", "set", "require-marker", "names"})
    BOOST_TEST(contains(text, std::string("--") + option), option);
}

BOOST_AUTO_TEST_SUITE_END()
