// Faults in the whole system: what hardware and software make of them.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "executable.h"

using namespace integration;

namespace {

struct Faults : Workplace {
  kit::Outcome inject(const std::string& fault, const Arguments& more = {}) const {
    Arguments arguments{"z1.0",        "z2.0",  "--no-pictures",
                        "--no-report", "--set", "inject=[" + fault + "]"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  /// What the units came to, and when.
  std::string frames() const { return result()["frames"].dump(); }
  Json injected() const { return result()["injected"][0]; }

  kit::Outcome campaign(const std::string& text, const Arguments& more = {}) const {
    std::ofstream(*this / "c.yaml") << text;
    Arguments arguments{"faults", "c.yaml", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  }
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

}  // namespace

BOOST_FIXTURE_TEST_SUITE(faults_of_a_run, Faults)

BOOST_AUTO_TEST_CASE(a_fault_that_does_not_happen_changes_nothing) {
  BOOST_TEST(run({"z1.0", "z2.0", "--no-pictures", "--no-report"}).exit_code == 0);
  const std::string right = frames();
  BOOST_TEST(!result().contains("injected"));
  for (const char* fault :
       {"{what: slverr, where: axi_dma_0, access: 100000}",
        "{what: corrupt, where: pl.axi_dma_0.m_axi_mm2s.link, bit: 3, access: 100000}",
        "{what: lost, where: pl.axi_dma_0.mm2s_introut, edge: 100000}",
        "{what: flip, address: 0x10000000, bit: 3, at: 9 s}"}) {
    const kit::Outcome outcome = inject(fault);
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    BOOST_TEST((frames() == right), fault << " changes the run");
    BOOST_TEST(injected()["times"] == 0);
    BOOST_TEST(contains(outcome.out, "never happened in this run"), outcome.out);
  }
}

BOOST_AUTO_TEST_CASE(a_bus_error_aborts_the_access) {
  const kit::Outcome outcome = inject("{what: slverr, where: axi_dma_0, access: 3}");
  BOOST_TEST(outcome.exit_code == 3);
  BOOST_TEST(contains(outcome.err, "SLVERR, the device reports an error, at 64.36 us"),
             outcome.err);
  BOOST_TEST(injected()["first_us"] == 64.36);
  BOOST_TEST(contains(inject("{what: decerr, where: axi_gpio_0}").err, "DECERR"));
}

BOOST_AUTO_TEST_CASE(the_software_survives_a_lost_interrupt) {
  const kit::Outcome outcome = inject("{what: lost, where: pl.axi_dma_1.s2mm_introut}");
  const Json frames = result()["frames"];
  BOOST_TEST(frames[0]["gave_up"] == "binary image timed out");
  BOOST_TEST(!frames[1].contains("gave_up"));
  BOOST_TEST(outcome.exit_code == 1);
}

BOOST_AUTO_TEST_CASE(both_fidelities_make_the_same_of_a_fault) {
  for (const char* fault :
       {"{what: flip, where: pl.axi_dma_0.s_axi_lite.MM2S_DMACR, bit: 0, at: 2 ms}",
        "{what: corrupt, where: pl.axi_dma_0.m_axi_mm2s.link, bit: 77, access: 900}",
        "{what: clock, where: ps.fclk_clk1.clk, frequency: 25 MHz, at: 8 ms}"}) {
    inject(fault, {"--frames", "1", "--fidelity", "tlm"});
    const std::string tlm = frames();
    BOOST_TEST(injected()["times"] == 1, fault);
    inject(fault, {"--frames", "1", "--fidelity", "clocked"});
    BOOST_TEST((frames() == tlm), fault << " differs between fidelities");
  }
}

BOOST_AUTO_TEST_CASE(beats_of_a_stream_go_wrong) {
  BOOST_TEST(run({"z1.0", "z2.0", "--no-pictures", "--no-report"}).exit_code == 0);
  const std::string right = frames();
  const auto what = [this](const std::string& kind, const std::string& stream,
                           const std::string& beat) {
    return inject("{what: " + kind + ", where: " + stream + ", beat: " + beat + "}");
  };
  what("dropped", "pl.image_stream", "100000000");
  BOOST_TEST((frames() == right), "beats that pass one by one pass at the same times");
  BOOST_TEST(contains(what("repeated", "pl.image_stream", "1000").out, "at 4.86636 ms"));
  what("tlast", "pl.binary_stream", "3");
  BOOST_TEST(result()["frames"][0]["markers"].empty());
  what("dropped", "pl.image_stream", "1000");
  BOOST_TEST(injected()["first_us"] == 130.11);
  what("corrupt, bit: 31", "pl.image_stream", "1000");
  BOOST_TEST(injected()["first_us"] == 130.1, "a beat is offered before it passes");
}

BOOST_AUTO_TEST_CASE(inputs_are_spoiled_and_reports_know_the_right_one) {
  inject("{what: input, value: 0, unit: 2}");
  BOOST_TEST(result()["frames"][0]["markers"].size() == 1u);
  BOOST_TEST(result()["frames"][1]["markers"].empty());
  inject("{what: torn, from: 0, unit: 2}");
  const Json frames = result()["frames"];
  BOOST_TEST(frames[1]["markers"][0]["corners_px"] == frames[0]["markers"][0]["corners_px"]);
}

BOOST_AUTO_TEST_CASE(a_list_in_a_file_is_the_same) {
  std::ofstream(*this / "f.yaml") << "inject:\n  - what: decerr\n    where: axi_gpio_0\n";
  const kit::Outcome outcome = run({"z1.0", "--no-report", "--config", "f.yaml"});
  BOOST_TEST(outcome.exit_code == 3);
  BOOST_TEST(injected()["fault"] == "{what: decerr, where: axi_gpio_0}");
}

BOOST_AUTO_TEST_CASE(places_that_there_are_not_are_refused_with_the_nearest) {
  for (const auto& [fault, problem] : std::vector<std::pair<std::string, std::string>>{
           {"{what: slverr, where: axi_dma_9}", "'axi_dma_9' is not the path of a link of a bus"},
           {"{what: lost, where: pl.axi_dma_0.mm2s_intrut}",
            "did you mean 'pl.axi_dma_0.mm2s_introut'?"},
           {"{what: stuck, where: pl.axi_dma_0.mm2s_introut, value: 2, at: 1 ms}",
            "has 1 bits: 'value' does not fit"},
           {"{what: stuck, where: pl.sensor_input.pixel, value: 1, at: 1 ms}",
            "does not move as in hardware where pl.fidelity.sensor_input is tlm"},
           {"{what: flip, address: 0x10000001, bit: 0, at: 1 ms}", "a multiple of 4"},
           {"{what: flip, address: 0x90000000, bit: 0, at: 1 ms}", "no memory and no register"},
           {"{what: flip, where: pl.bram, address: 400000, bit: 0, at: 1 ms}", "0 to 307199"},
           {"{what: flip, where: pl.axi_dma_0.s_axi_lite.MM2S_DMACX, bit: 0, at: 1 ms}",
            "did you mean 'MM2S_DMACR'?"},
           {"{what: flip, where: pl.axi_dma_0.s_axi_lite.MM2S_DMACR, address: 8, bit: 0, at: 1 ms}",
            "'address' is a byte of a memory"},
           {"{what: clock, where: ps.fclk_clk7, frequency: 0 Hz, at: 1 ms}", "a clock"}}) {
    const kit::Outcome outcome = inject(fault);
    BOOST_TEST(outcome.exit_code == 2, fault);
    BOOST_TEST(contains(outcome.err, problem), outcome.err << " lacks " << problem);
  }
}

BOOST_AUTO_TEST_CASE(a_campaign_is_the_same_with_any_number_of_jobs) {
  const std::string text = "design: thesis\ninputs: [z1.0, z2.0]\ncount: 40\nseed: 7\n";
  BOOST_TEST_REQUIRE(campaign(text, {"--jobs", "1", "-o", "one"}).exit_code == 0);
  BOOST_TEST_REQUIRE(campaign(text, {"--jobs", "2", "-o", "two"}).exit_code == 0);
  const std::string csv = kit::read_file(*this / "one/faults.csv");
  BOOST_TEST(lines_of(csv).size() == 41u);
  BOOST_TEST((csv == kit::read_file(*this / "two/faults.csv")));
  const Json counts = Json::parse(kit::read_file(*this / "one/faults.json"));
  const Json all = counts["all"];
  BOOST_TEST(all["faults"] == 40);
  BOOST_TEST(all["broken"] == 0);
  std::uint64_t with_bit = 0;
  for (const auto& [bit, of_bit] : counts["bits"].items())
    with_bit += of_bit["faults"].get<std::uint64_t>();
  const std::vector<std::string> lines = lines_of(csv);
  BOOST_TEST(with_bit == std::count_if(lines.begin(), lines.end(), [](const std::string& line) {
               return contains(line, ", bit: ");
             }));
  const std::string page = kit::read_file(*this / "one/report.html");
  BOOST_TEST(contains(page, "id=\"faults\""));
}

// What the run without faults tells of a fault is what the fault does.
BOOST_AUTO_TEST_CASE(faults_that_need_no_simulation_come_to_the_same_with_it) {
  const std::string text =
      "inputs: [z1.0, z2.0]\ncount: 90\nseed: 5\nclasses: [bus, memory, signal, input]\n";
  BOOST_TEST_REQUIRE(campaign(text + "simulate: all\n", {"-o", "all"}).exit_code == 0);
  const kit::Outcome outcome = campaign(text, {"-o", "needed"});
  BOOST_TEST_REQUIRE(outcome.exit_code == 0);
  std::vector<std::string> needed = lines_of(kit::read_file(*this / "needed/faults.csv"));
  std::map<std::string, std::set<std::string>> classes;
  for (std::string& line : needed) {
    for (const std::string known : {"record", "twin"}) {
      const std::size_t at = line.find("," + known + ",");
      if (at == std::string::npos) continue;
      line.replace(at + 1, known.size(), "run");
      const std::size_t from = line.find(',') + 1;
      classes[known].insert(line.substr(from, line.find(',', from) - from));
    }
  }
  BOOST_TEST((needed == lines_of(kit::read_file(*this / "all/faults.csv"))));
  BOOST_TEST((classes["record"] == std::set<std::string>{"bus", "memory", "signal"}));
  BOOST_TEST(classes["twin"].count("input") == 1u);
  const Json known = Json::parse(kit::read_file(*this / "needed/faults.json")).at("known");
  BOOST_TEST(known.at("run").get<int>() + known.at("record").get<int>() +
                 known.at("twin").get<int>() ==
             90);
  BOOST_TEST(contains(outcome.out, "simulated: " + known.at("run").dump() + " faults;"));
}

// The program gives a frame up after a second, resets the logic, and the next frame is right.
BOOST_AUTO_TEST_CASE(a_campaign_waits_for_time_outs_of_the_program) {
  const std::string text =
      "inputs: [z1.0, z2.0]\ncount: 12\nseed: 1\nclasses: internal\n"
      "below: [pl.feature_packaging.want]\n";
  const auto counts = [this] {
    return Json::parse(kit::read_file(*this / "out/faults/faults.json")).at("all");
  };
  BOOST_TEST_REQUIRE(campaign(text + "patience: 1 ms\n").exit_code == 0);
  const int hangs = counts().at("hang");
  BOOST_TEST(hangs > 0);
  BOOST_TEST_REQUIRE(campaign(text).exit_code == 0);
  BOOST_TEST(counts().at("hang") == 0);
  BOOST_TEST(counts().at("recovered").get<int>() + counts().at("reported").get<int>() >= hangs);
}

BOOST_AUTO_TEST_CASE(a_clock_changes_for_good) {
  const std::string clock = "{what: clock, where: ps.fclk_clk0.clk, at: 2 ms, frequency: ";
  BOOST_TEST(run({"z1.0", "z2.0", "--no-pictures", "--no-report"}).exit_code == 0);
  const double usual_us = result()["program_end"]["time_us"];
  BOOST_TEST(inject(clock + "50 MHz}").exit_code == 0);
  const double slow_us = result()["program_end"]["time_us"];
  BOOST_TEST((slow_us > usual_us && slow_us < 2 * usual_us), slow_us << " for " << usual_us);
  const kit::Outcome outcome = inject(clock + "0 Hz}");
  BOOST_TEST(outcome.exit_code == 3);
  BOOST_TEST(contains(outcome.err, "bus hang"), outcome.err);
  BOOST_TEST(contains(inject(clock + "0 Hz, for: 10 us}").err, "'clock' takes no 'for'"));
}

// Each line is a run with `inject`, whatever came of it.
BOOST_AUTO_TEST_CASE(a_shot_of_a_campaign_can_be_had_again) {
  // Less patience than the program's time-outs: what would recover is a hang that nothing told of.
  const std::string text = "inputs: [z1.0, z2.0]\ncount: 60\nseed: 3\npatience: 10 ms\n";
  BOOST_TEST_REQUIRE(run({"z1.0", "z2.0", "--no-pictures", "--no-report"}).exit_code == 0);
  const std::size_t units = result()["frames"].size();
  BOOST_TEST_REQUIRE(campaign(text + "classes: [bus, register, signal, clock]\n").exit_code == 0);
  std::map<std::string, int> seen;
  std::uint64_t silent = 0;
  for (const std::string& line : lines_of(kit::read_file(*this / "out/faults/faults.csv"))) {
    silent += contains(line, ",hang,") && line.back() == ',';
    const std::size_t from = line.find("\"{"), to = line.find("}\"");
    if (from == std::string::npos) continue;
    const std::string outcome = contains(line, ",masked,") ? "masked"
                                : contains(line, ",hang,") ? "hang"
                                                           : "other";
    if (++seen[outcome] > 3) continue;
    const kit::Outcome again = inject(line.substr(from + 1, to - from));
    const bool whole = again.exit_code == 0 && result()["frames"].size() == units;
    BOOST_TEST((outcome == "masked" ? whole : true), line);
    BOOST_TEST((outcome == "hang" ? !whole : true), line);
  }
  BOOST_TEST(seen["masked"] > 0);
  BOOST_TEST(seen["hang"] > 0);
  BOOST_TEST(silent > 0);
  const Json counts = Json::parse(kit::read_file(*this / "out/faults/faults.json"));
  BOOST_TEST(counts["all"]["silent_hangs"] == silent);
}

BOOST_AUTO_TEST_CASE(a_campaign_that_cannot_be_is_refused) {
  const auto refuses = [this](const std::string& text, const std::string& problem) {
    const kit::Outcome outcome = campaign(text);
    BOOST_TEST(outcome.exit_code == 2, text);
    BOOST_TEST(contains(outcome.err, problem), outcome.err << " lacks " << problem);
  };
  refuses("", "c.yaml: it is empty");
  refuses("classes: [buss]", "did you mean 'bus'?");
  refuses("simulate: some", "c.yaml:1: 'some' for 'simulate'");
  refuses("patience: 3", "c.yaml:1: '3' for 'patience'");
  refuses("count: 0", "c.yaml:1: '0' for 'count'");
  refuses("desing: thesis", "did you mean 'design'?");
  refuses("design: thesis\nbelow: [pl.nothing]", "nothing is below pl.nothing");
  refuses("design: thesis\nset: {pl.widht: 3}", "pl.widht");
}

BOOST_AUTO_TEST_SUITE_END()
