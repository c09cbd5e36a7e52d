// RTL built outside of the tree, in place of models of the installed executable.
#include <boost/test/unit_test.hpp>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "../integration/pictures.h"
#include "installation.h"

using namespace install_test;

namespace {

using Json = nlohmann::ordered_json;

/// That of the thesis.
const char* const camera =
    "image_width: 640\nimage_height: 480\ncamera_name: thesis\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [381.36, 0, 319.5, 0, 381.36, 239.5, 0, 0, 1]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n";

struct Rtl {
  std::string file(const std::string& ip) const {
    installed.build(installed / "share/markervp/examples/07_own_rtl", "07_own_rtl");
    return installed.beside("07_own_rtl/" + ip + ".so");
  }
  std::string setting(const std::string& ip) const { return "pl.fidelity." + ip + "=" + file(ip); }

  Json run(const std::string& name, const Words& more) const {
    return installed.result(name, more);
  }
  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// Two scenes, noise, and two soft, noisy pictures, with the camera of the thesis.
  Words pictures(const Words& more = {}) const {
    cv::Mat noise(480, 640, CV_8UC1);
    cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 256);
    integration::write_picture(installed.beside("noise.png"), noise);
    for (const std::string scene : {"demo", "z1.0"})
      integration::write_picture(installed.beside("photograph_" + scene + ".png"),
                                 integration::photograph(scene));
    kit::write_file(installed.beside("camera.yaml"), camera);
    return with(
        {"demo", "z2.0", installed.beside("noise.png"), installed.beside("photograph_demo.png"),
         installed.beside("photograph_z1.0.png"), "--camera", installed.beside("camera.yaml")},
        more);
  }
  /// Of VHDL that was not synthesised power is not known.
  static Json without_power(Json result) {
    for (Json& frame : result["frames"]) frame.erase("energy_mj");
    for (const char* figure : {"power_w", "energy_per_frame_mj"}) result["summary"].erase(figure);
    return result;
  }
  static void check_same(const Json& a, const Json& b) {
    for (const char* part : {"frames", "summary", "power", "verdict"})
      BOOST_TEST(a[part] == b[part], part);
  }

  /// A module in place of the corner detection, of which `ports` and `body` are given, built with
  /// `more` of the CMake function's arguments.
  kit::Outcome configure(const std::string& name, const std::string& ports, const std::string& body,
                         const std::string& more = "") const {
    const std::string folder = installed.beside(name + "_source");
    std::filesystem::create_directory(folder);
    kit::write_file(folder + "/" + name + ".sv",
                    "module " + name + "(\n" + ports + ");\n" + body + "\nendmodule\n");
    kit::write_file(folder + "/CMakeLists.txt",
                    "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
                    "find_package(markervp REQUIRED COMPONENTS rtl)\nmarkervp_add_rtl(" +
                        name + " IP corner_detection TOP " + name + " SOURCES " + name + ".sv " +
                        more + ")\n");
    // None of these runs for long: Verilator's runtime compiles in a third of the time.
    return installed.configure(folder, name, {"-DCMAKE_BUILD_TYPE=Debug"});
  }
  /// A part of a design.
  kit::Outcome configure_part(const std::string& name, const std::string& file,
                              const std::string& text) const {
    const std::string folder = installed.beside(name + "_source");
    std::filesystem::create_directory(folder);
    kit::write_file(folder + "/" + file, text);
    kit::write_file(folder + "/CMakeLists.txt",
                    "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
                    "find_package(markervp REQUIRED COMPONENTS rtl)\nmarkervp_add_rtl(" +
                        name + " TOP " + name + " SOURCES " + file + ")\n");
    return installed.configure(folder, name);
  }
  static std::string vhdl(const std::string& name, const std::string& port,
                          const std::string& body) {
    return "library ieee;\nuse ieee.std_logic_1164.all;\nuse ieee.numeric_std.all;\nentity " +
           name + " is\n  " + port + "\nend;\narchitecture rtl of " + name + " is begin\n  " +
           body + "\nend;\n";
  }
  /// CMake wraps its lines.
  static std::string words(const std::string& text) {
    std::istringstream stream(text);
    std::string word, all;
    while (stream >> word) all += (all.empty() ? "" : " ") + word;
    return all;
  }
  /// How a run ends that loads it.
  kit::Outcome load(const std::string& name, const std::string& ports,
                    const std::string& body) const {
    const kit::Outcome configured = configure(name, ports, body);
    BOOST_TEST_REQUIRE(configured.exit_code == 0, configured.err);
    const kit::Outcome built = installed.build_target(name, "all");
    BOOST_TEST_REQUIRE(built.exit_code == 0, built.out + built.err);
    return installed.markervp(
        {"run", "--output", "never", "--set",
         "pl.fidelity.corner_detection=" + installed.beside(name + "/" + name + ".so")});
  }

  const Installation& installed = Installation::get();
};

const std::string inputs =
    "input logic clk,\ninput logic ena,\ninput logic rst,\ninput logic [7:0] pixel,\n"
    "input logic [9:0] x,\ninput logic [8:0] y,\n";
const std::string outputs = "output logic corner_out,\noutput logic [31:0] corner_data";
const std::string nothing =
    "assign corner_out = &{1'b0, clk, ena, rst, pixel, x, y};\n"
    "assign corner_data = 0;";

}  // namespace

BOOST_FIXTURE_TEST_SUITE(rtl, Rtl)

BOOST_AUTO_TEST_CASE(the_example_prints_what_its_readme_shows) {
  file("corner_detection");
  const std::string source = MARKERVP_SOURCE;
  const kit::Outcome outcome =
      installed.run("/usr/bin/env", {"python3", source + "/tests/examples/examples_test.py",
                                     installed / "bin/markervp", source + "/examples",
                                     installed.beside(""), "--only", "07_own_rtl"});
  BOOST_TEST(outcome.exit_code == 0, outcome.out + outcome.err);
}

// Each among models of whole frames as far as it goes with them, the detectors together, and the
// whole pipeline; Verilog and VHDL.
BOOST_AUTO_TEST_CASE(the_same_result_as_the_models) {
  const Words inputs = pictures();
  const Json models = run("models", inputs);
  const Words detectors{"corner_detection", "global_threshold", "blob_detection"};
  for (const std::string& ip : detectors) {
    Words arguments = inputs;
    arguments.insert(arguments.end(), {"--set", setting(ip)});
    // The binary image goes from one to the other pixel by pixel.
    if (ip == "global_threshold")
      arguments.insert(arguments.end(), {"--set", "pl.fidelity.blob_detection=clocked"});
    const Json result = run("rtl_" + ip, arguments);
    BOOST_TEST(without_power(result)["frames"] == without_power(models)["frames"], ip);
    if (ip == "global_threshold") {  // VHDL of the template's own
      BOOST_TEST(result["resources"]["unknown"] == Json{"pl.global_threshold"});
      BOOST_TEST(result["verdict"]["fits"]["holds"] == "unknown");
    } else if (ip == "corner_detection") {  // built with LEAN=1, which has figures of its own
      BOOST_TEST(result["resources"]["total"]["lut"] < models["resources"]["total"]["lut"]);
    } else {
      BOOST_TEST(result["frames"] == models["frames"], ip);
      BOOST_TEST(result["resources"] == models["resources"], ip);
    }
  }
  for (const std::string ip : {"axi_image_store", "axi_threshold_bridge", "clock_crossing",
                               "feature_packaging", "frame_status"}) {
    Words arguments = inputs;
    arguments.insert(arguments.end(), {"--set", setting(ip)});
    BOOST_TEST(run("rtl_" + ip, arguments)["frames"] == models["frames"], ip);
  }
  Words all = inputs;
  for (const std::string& ip : detectors) all.insert(all.end(), {"--set", setting(ip)});
  const Json expected = without_power(models);
  BOOST_TEST(without_power(run("rtl_detectors", all))["frames"] == expected["frames"]);
  for (const std::string ip : {"sensor_input", "axi_image_store", "axi_threshold_bridge",
                               "clock_crossing", "feature_packaging", "frame_status"})
    all.insert(all.end(), {"--set", setting(ip)});
  const Json pipeline = without_power(run("rtl_all", all));
  for (const char* part : {"frames", "summary"}) BOOST_TEST(pipeline[part] == expected[part], part);
}

BOOST_AUTO_TEST_CASE(the_same_result_as_the_models_of_improved) {
  const Words inputs = pictures({"--design", "improved"});
  const Json models = run("improved", inputs);
  BOOST_TEST(models["summary"]["detected"] >= 4);
  check_same(run("improved_clocked", with(inputs, {"--fidelity", "clocked"})), models);
  Words all = inputs;
  for (const std::string ip :
       {"camera", "otsu_threshold", "blob_labelling", "pixel_stream", "blob_stream"}) {
    const Words own = with(inputs, {"--fidelity", "clocked", "--set", setting(ip)});
    BOOST_TEST(run("improved_" + ip, own)["frames"] == models["frames"], ip);
    all = with(all, {"--set", setting(ip)});
  }
  check_same(run("improved_all", all), models);
}

BOOST_AUTO_TEST_CASE(the_same_result_as_the_models_with_a_local_threshold) {
  const Words inputs = pictures({"--design", "improved", "--set", "pl.threshold_rule=local"});
  const Json models = run("local", inputs);
  BOOST_TEST(models["summary"]["detected"] >= 4);
  const Words clocked = with(inputs, {"--fidelity", "clocked"});
  check_same(run("local_clocked", clocked), models);
  check_same(run("local_rtl", with(clocked, {"--set", setting("local_threshold")})), models);
}

BOOST_AUTO_TEST_CASE(the_same_result_as_the_models_with_a_clock_of_the_camera) {
  const Words inputs{"demo",     "z2.0",  "--design",
                     "improved", "--set", "pl.camera_clk.frequency=25.175 MHz"};
  const Json models = run("own_clock", inputs);
  BOOST_TEST(models["summary"]["detected"] == 2);
  const std::string stream = file("stream_crossing");
  Words all = inputs;
  for (const std::string& crossing :
       {setting("control_crossing"), "pl.fidelity.pixel_crossing=" + stream,
        "pl.fidelity.blob_crossing=" + stream}) {
    check_same(run("own_clock_rtl", with(inputs, {"--set", crossing})), models);
    all = with(all, {"--set", crossing});
  }
  for (const std::string ip :
       {"camera", "otsu_threshold", "blob_labelling", "pixel_stream", "blob_stream"})
    all = with(all, {"--set", setting(ip)});
  check_same(run("own_clock_all_rtl", all), models);
  check_refused(installed.markervp({"run", "demo", "--design", "improved", "--output", "never",
                                    "--set", "pl.fidelity.pixel_crossing=" + stream}),
                {"pl.fidelity.pixel_crossing", "nothing crosses", "pl.camera_clk.frequency"});
}

BOOST_AUTO_TEST_CASE(a_check_and_vectors_of_an_ip_between_two_clocks) {
  const Words own_clock{"demo", "--design", "improved", "--set",
                        "pl.camera_clk.frequency=25.175 MHz"};
  const kit::Outcome outcome =
      installed.markervp(with({"rtl", "check", "pixel_crossing", "--rtl", file("stream_crossing"),
                               "--no-stimuli", "--output", "check_crossing"},
                              own_clock));
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "equal: pixel_crossing"), outcome.out);
  const kit::Outcome vectors = installed.markervp(
      with({"rtl", "vectors", "blob_crossing", "--output", "crossing_vectors"}, own_clock));
  BOOST_TEST(vectors.exit_code == 0, vectors.err);
  BOOST_TEST(contains(kit::read_file(installed.beside("crossing_vectors/bench.sv")),
                      "{clk, m_clk} = rises;"));
}

// All IP that take several pixels a clock together in the running system, with each threshold, at
// the design's 100 MHz, which all of them meet.
BOOST_AUTO_TEST_CASE(the_same_result_as_the_models_with_several_pixels_a_clock) {
  const std::string folder = installed.beside("group_rtl_source");
  std::filesystem::create_directory(folder);
  kit::write_file(folder + "/CMakeLists.txt", R"(cmake_minimum_required(VERSION 3.25)
project(group_rtl LANGUAGES CXX)
find_package(markervp REQUIRED COMPONENTS rtl)
file(GLOB common ${markervp_RTL}/common/*.sv)
foreach(ip camera otsu_threshold global_threshold local_threshold blob_labelling pixel_stream)
  file(GLOB sources ${markervp_RTL}/${ip}/*.sv)
  foreach(pixels 2 4)
    markervp_add_rtl(${ip}_${pixels} IP ${ip} TOP ${ip} SOURCES ${sources} ${common}
      PARAMETERS PIXELS_PER_CLOCK=${pixels})
  endforeach()
endforeach()
)");
  installed.build(folder, "group_rtl");
  for (const std::string pixels : {"2", "4"}) {
    for (const std::string rule : {"otsu", "global", "local"}) {
      const std::string name = rule + "_" + pixels;
      const Words inputs = pictures({"--design", "improved", "--set", "pl.threshold_rule=" + rule,
                                     "--set", "pl.pixels_per_clock=" + pixels});
      const Json models = run(name, inputs);
      BOOST_TEST(models["summary"]["detected"] >= 4);
      Words all = inputs;
      for (const std::string& ip : {std::string("camera"), rule + "_threshold",
                                    std::string("blob_labelling"), std::string("pixel_stream")}) {
        all = with(all, {"--set", "pl.fidelity." + ip + "=" +
                                      installed.beside("group_rtl/" + ip + "_" + pixels + ".so")});
      }
      check_same(run(name + "_rtl", with(all, {"--set", setting("blob_stream")})), models);
    }
  }
}

// The detector behind the threshold takes pixels then, without being told to.
BOOST_AUTO_TEST_CASE(a_check_chooses_models_that_go_with_the_rtl) {
  const kit::Outcome outcome =
      installed.markervp({"rtl", "check", "global_threshold", "--rtl", file("global_threshold"),
                          "demo", "--output", "check_threshold"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  BOOST_TEST(contains(outcome.out, "equal: global_threshold"), outcome.out);
  check_refused(installed.markervp(
                    {"run", "demo", "--output", "never", "--set", setting("global_threshold")}),
                {"choose pl.fidelity.blob_detection=clocked"});
}

// `verilator --sc`, and a module that knows nothing of ours, at the pins.
BOOST_AUTO_TEST_CASE(systemc_at_the_pins) {
  installed.build(project("pins"), "pins");
  const std::string design = installed.beside("pins/pins.so");
  const Json models = run("without_pins", {"demo"});
  const Json pins =
      run("with_pins", {"demo", "--design", design, "--set", "pl.fidelity.corner_detection=pins"});
  BOOST_TEST(pins["frames"] == models["frames"]);
  BOOST_TEST(pins["summary"]["detected"] == 1);
  const kit::Outcome told = installed.markervp(
      {"run", "demo", "--design", design, "--output", "told", "--no-report", "--no-pictures"});
  BOOST_TEST(contains(told.out, "pixels counted: 307200\n"), told.out);
}

BOOST_AUTO_TEST_CASE(ports_that_do_not_fit_are_named_with_file_and_line) {
  const std::string narrow =
      "input logic clk,\ninput logic ena,\ninput logic rst,\n"
      "input logic [6:0] pixel,\ninput logic [9:0] x,\ninput logic [8:0] y,\n";
  check_refused(load("narrow", narrow + outputs, nothing),
                {"narrow.so", "corner_detection", "narrow.sv:5", "'pixel'", "7 bits",
                 "'input logic [7:0] pixel'"});
  check_refused(
      load("lacking", inputs + "output logic corner_out",
           "assign corner_out = &{1'b0, clk, ena, rst, pixel, x, y};"),
      {"lacking.sv:1", "lacks the port 'corner_data'", "'output logic [31:0] corner_data'"});
  check_refused(load("extra", inputs + "input logic debug,\n" + outputs,
                     "assign corner_out = &{1'b0, clk, ena, rst, pixel, x, y, debug};\n"
                     "assign corner_data = 0;"),
                {"extra.sv:8", "no port 'debug'", "remove it"});
}

BOOST_AUTO_TEST_CASE(another_ip_another_size_and_no_rtl_are_refused) {
  const auto refused = [this](const Words& settings) {
    Words arguments{"run", "--output", "never"};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    return installed.markervp(arguments);
  };
  check_refused(refused({"pl.fidelity.corner_detection=" + file("blob_detection")}),
                {"built as blob_detection", "pl.fidelity.blob_detection"});
  check_refused(refused({setting("corner_detection"), "pl.corner_detection.threshold=40"}),
                {"corner_detection.sv", "THRESHOLD is 30", "PARAMETERS THRESHOLD=40"});
  check_refused(refused({setting("global_threshold"), "pl.fidelity.blob_detection=clocked",
                         "pl.width=320 px"}),
                {"WIDTH is 640", "pl.width", "PARAMETERS WIDTH=320"});
  check_refused(refused({"pl.fidelity.corner_detection=./none.so"}),
                {"none.so", "cannot load RTL"});
  check_refused(
      refused({"pl.fidelity.corner_detection=" + (installed / "lib/markervp/programs/hybrid.so")}),
      {"hybrid.so", "is not RTL", "markervp_add_rtl"});
}

BOOST_AUTO_TEST_CASE(what_verilator_refuses_is_told_when_it_is_configured) {
  const auto refused = [](const kit::Outcome& outcome, const Words& parts) {
    BOOST_TEST(outcome.exit_code != 0);
    for (const std::string& part : parts) BOOST_TEST(contains(outcome.err, part), outcome.err);
  };
  refused(configure("wrong", inputs + outputs, "assign corner_out = nobody;"),
          {"wrong.sv:10", "nobody", "markervp_add_rtl(wrong)", "mend"});
  refused(configure("latch", inputs + outputs,
                    "always_comb if (ena) corner_out = clk ^ rst ^ ^pixel ^ ^x ^ ^y;\n"
                    "assign corner_data = 0;"),
          {"latch.sv:10", "atch", "mend"});
  refused(configure("loop", inputs + outputs,
                    "logic a, b;\nassign a = b ^ clk;\nassign b = a | ena;\n"
                    "assign corner_out = a ^ rst ^ ^pixel ^ ^x ^ ^y;\nassign corner_data = 0;"),
          {"loop.sv:10", "Circular combinational logic", "mend"});
  refused(configure("late", inputs + outputs,
                    "assign corner_data = 0;\n"
                    "always @(posedge clk) #5 corner_out <= ena ^ rst ^ ^pixel ^ ^x ^ ^y;"),
          {"late.sv:11", "delays", "mend"});
  refused(configure("top", inputs + outputs, nothing, "TOP another"), {"another", "mend"});
  refused(configure("missing", inputs + outputs, nothing, "missing_too.sv"),
          {"there is no file", "missing_too.sv"});
}

// RTL that replaces no IP: registers, memory and interrupt in a design with a PS program.
BOOST_AUTO_TEST_CASE(rtl_as_a_part_of_a_design) {
  installed.build(project("rtl_part"), "rtl_part");
  const std::string design = installed.beside("rtl_part/rtl_part.so");
  const kit::Outcome outcome = installed.markervp(
      {"run", "demo", "--design", design, "--output", "with_part", "--no-pictures"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.out + outcome.err);
  BOOST_TEST(contains(outcome.out, "bytes copied: 4096\n"), outcome.out);
  const kit::Outcome map = installed.markervp({"map", "--design", design});
  BOOST_TEST(contains(map.out, "0x43C00000..0x43C0FFFF"), map.out);
  BOOST_TEST(contains(map.out, "RTL everything"), map.out);
  BOOST_TEST(contains(map.out, "63  pl.copier.interrupt"), map.out);
  const kit::Outcome registers = installed.markervp({"map", "copier", "--design", design});
  BOOST_TEST(contains(registers.out, "0x43C00010  FROM"), registers.out);
  const Json result = Json::parse(kit::read_file(installed.beside("with_part/result.json")));
  // Its synthesis is part of the build.
  BOOST_TEST(!result["resources"].contains("unknown"), result["resources"].dump());
  const Json& modules = result["resources"]["modules"];
  const auto copier = std::find_if(modules.begin(), modules.end(), [](const Json& module) {
    return module["name"] == "pl.copier";
  });
  BOOST_TEST((*copier)["lut"] > 100, copier->dump());
}

// A port more, and an output that is no register any more: what is known of the RTL follows.
BOOST_AUTO_TEST_CASE(changed_rtl_is_looked_at_anew) {
  const std::string folder = installed.beside("changed_source");
  std::filesystem::create_directory(folder);
  const auto write = [&](const std::string& ports, const std::string& body) {
    kit::write_file(folder + "/changed.sv", "module changed(input logic clk, input logic a, " +
                                                ports + ");\n" + body + "\nendmodule\n");
  };
  kit::write_file(folder + "/CMakeLists.txt",
                  "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
                  "find_package(markervp REQUIRED COMPONENTS rtl)\n"
                  "markervp_add_rtl(changed TOP changed SOURCES changed.sv)\n");
  const auto notes = [&] {
    return kit::read_file(installed.beside("changed/changed.rtl/glue.cpp"));
  };
  write("output logic q", "always_ff @(posedge clk) q <= a;");
  BOOST_TEST_REQUIRE(installed.configure(folder, "changed").exit_code == 0);
  BOOST_TEST_REQUIRE(installed.build_target("changed", "all").exit_code == 0);
  BOOST_TEST(contains(notes(), "{\"registered\""));
  std::this_thread::sleep_for(std::chrono::seconds(1));  // for the build's times
  write("output logic q, output logic z", "always_ff @(posedge clk) q <= a;\nassign z = !a;");
  const kit::Outcome rebuilt = installed.build_target("changed", "all");
  BOOST_TEST_REQUIRE(rebuilt.exit_code == 0, rebuilt.out + rebuilt.err);
  BOOST_TEST(contains(notes(), "{\"z\", 1, 1, "));
  BOOST_TEST(!contains(notes(), "{\"registered\""));
}

// Of RTL that replaces no IP.
BOOST_AUTO_TEST_CASE(what_cannot_be_a_part_is_told_when_it_is_configured) {
  const auto refused = [&](const std::string& file, const std::string& text, const Words& parts) {
    const std::string name = file.substr(0, file.find('.'));
    const kit::Outcome outcome = configure_part(name, file, text);
    BOOST_TEST(outcome.exit_code != 0, file);
    for (const std::string& part : parts) BOOST_TEST(contains(words(outcome.err), part), file);
  };
  refused("locked.v", "module locked(input clk);\n`pragma protect begin_protected\nendmodule\n",
          {"locked.v' is encrypted", "take a model in its place"});
  refused("open.v",
          "module open(input clk, output q);\n  vendor_cell u(.c(clk), .q(q));\nendmodule\n",
          {"open.v:2", "module 'vendor_cell' is in none of the sources", "add the file"});
  refused("both.v", "module both(input clk,\n  inout sda);\nendmodule\n",
          {"both.v:2", "port 'sda'", "give 'sda_i', 'sda_o' and 'sda_t'"});
  refused("bad.vhd", vhdl("bad", "port (clk : in std_logc);", ""),
          {"bad.vhd:5", "std_logc", "GHDL cannot synthesise 'bad'", "mend"});
  refused("shift.vhd",
          vhdl("shift", "port (clk : in std_logic; q : out unsigned(63 downto 0));",
               "q <= shift_left(to_unsigned(1, 64), 63);"),
          {"shift.vhd:8", "shift_left(to_unsigned(1, 64)", "write it as one literal"});
  // What may be wrong is said, for zeros are legal.
  const kit::Outcome table = configure_part(
      "table", "table.vhd",
      vhdl("table", "port (clk : in std_logic; q : out unsigned(63 downto 0));",
           "q <= unsigned'(x\"8000000100000000\") - unsigned'(x\"0000000100000000\");"));
  BOOST_TEST(table.exit_code == 0, table.err);
  BOOST_TEST(contains(words(table.err), "constants of 64 bits that came out as 0"), table.err);
}

/// Four parts of a design, of which two cannot be read, in a project of their own.
BOOST_AUTO_TEST_CASE(a_part_that_cannot_be_read_leaves_the_others_alone) {
  const std::string folder = installed.beside("parts_source");
  std::filesystem::create_directory(folder);
  kit::write_file(folder + "/good.v",
                  "module good(input clk, input a, output reg q);\n"
                  "always @(posedge clk) q <= a;\nendmodule\n");
  kit::write_file(folder + "/lacks.v",
                  "module lacks(input a, output q);\nvendors_cell cell_i(a, q);\nendmodule\n");
  kit::write_file(folder + "/pad.v",
                  "module pad(input a, inout p);\nassign p = a ? 1'bz : 1'b0;\nendmodule\n");
  kit::write_file(folder + "/bad.vhd",
                  "library ieee;\nuse ieee.std_logic_1164.all;\nentity bad is\n"
                  "  port (clk : in std_logc);\nend;\narchitecture rtl of bad is\nbegin\nend;\n");
  std::string text =
      "cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n"
      "find_package(markervp REQUIRED COMPONENTS rtl)\n";
  for (const std::string name : {"lacks.v", "pad.v", "bad.vhd", "good.v"}) {
    const std::string top = name.substr(0, name.find('.'));
    text += "markervp_add_rtl(" + top + " TOP " + top + " SOURCES " + name + " STUB_IF_REFUSED)\n";
    text += "set_target_properties(" + top + " PROPERTIES FOLDER parts)\n";
  }
  kit::write_file(folder + "/CMakeLists.txt", text);
  const kit::Outcome outcome = installed.configure(folder, "parts", {"-DCMAKE_BUILD_TYPE=Debug"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0, outcome.err);
  const auto reason = [&](const std::string& top) {
    return kit::read_file(installed.beside("parts/" + top + ".refused"));
  };
  BOOST_TEST(contains(reason("lacks"), "lacks.v:2"), reason("lacks"));
  BOOST_TEST(contains(reason("lacks"), "'vendors_cell' is in none of the sources"));
  BOOST_TEST(contains(reason("pad"), "give 'p_i', 'p_o' and 'p_t'"), reason("pad"));
  BOOST_TEST(contains(reason("bad"), "bad.vhd:4"), reason("bad"));
  BOOST_TEST(contains(outcome.err, "The design has a stub in its place"), outcome.err);
  const kit::Outcome built = installed.build_target("parts", "all");
  BOOST_TEST_REQUIRE(built.exit_code == 0, built.out + built.err);
  const auto exists = [&](const std::string& file) {
    return std::filesystem::exists(installed.beside("parts/" + file));
  };
  BOOST_TEST(exists("good.so"));
  for (const char* file : {"good.refused", "lacks.so", "pad.so", "bad.so"})
    BOOST_TEST(!exists(file), file);
}

BOOST_AUTO_TEST_SUITE_END()
