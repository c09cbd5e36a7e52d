// From a hand-off to a run: markervp import, and a program of the vendor's style on the design.
#include <boost/test/unit_test.hpp>
#include <string>

#include "executable.h"
#include "small_handoff.h"

using kit::replaced;
using namespace integration;

namespace {

/// A folder with small.hwh, imported into `mine`.
struct Imported : Workplace {
  Imported() { write_handoff(kit::small_handoff().text()); }

  void write_handoff(const std::string& text) const { kit::write_file(*this / "small.hwh", text); }
  kit::Outcome markervp(const Arguments& arguments) const {
    return kit::run_process(MARKERVP_EXECUTABLE, arguments, path());
  }
  kit::Outcome import() const { return markervp({"import", "small.hwh", "-o", "mine"}); }
  std::string file(const std::string& name) const {
    return kit::read_file(*this / ("mine/" + name));
  }
  kit::Outcome run_program(Arguments more = {}) const {
    Arguments all{"--design", "mine/design.yaml", "--program", MARKERVP_IMPORTED, "--no-report"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

bool has(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(imports)

BOOST_FIXTURE_TEST_CASE(a_program_runs_on_what_was_imported, Imported) {
  const kit::Outcome imported = import();
  BOOST_TEST(imported.exit_code == 0, imported.err);
  BOOST_TEST(has(imported.out, "10 parts, 1 stub"));
  BOOST_TEST(has(file("xparameters.h"), "#define XPAR_OWN_0_S00_AXI_BASEADDR 0x43C00000U"));
  const kit::Outcome ran = run_program({"--set", "pl.external_buttons.level=9"});
  BOOST_TEST(ran.exit_code == 0, ran.out + ran.err);
  BOOST_TEST(has(ran.out, "0 bytes wrong, length 101, interrupts 1, buttons 9, own 0"), ran.out);
  BOOST_TEST(has(ran.err, "me:user:own:1.0 has neither model nor RTL"), ran.err);
  BOOST_TEST(has(ran.out, "verdict  unknown: "), ran.out);
  BOOST_TEST(has(ran.out, "fits     unknown: at least LUT "), ran.out);
  const Json result = this->result();
  BOOST_TEST(result.at("resources").dump().find("a stub is in the place of me:user:own:1.0") !=
             std::string::npos);
}

BOOST_FIXTURE_TEST_CASE(faults_are_drawn_over_what_was_imported, Imported) {
  import();
  kit::write_file(*this / "c.yaml", "design: mine/design.yaml\nprogram: " MARKERVP_IMPORTED
                                    "\ncount: 200\nseed: 4\n");
  const kit::Outcome outcome = markervp({"faults", "c.yaml", "--quiet", "-o", "faults"});
  BOOST_TEST(outcome.exit_code == 0, outcome.err);
  const Json campaign = Json::parse(kit::read_file(*this / "faults/faults.json"));
  const auto count = [&](const char* outcome) { return campaign.at("all").at(outcome).get<int>(); };
  // A program that waits for interrupts behind its main() ends nevertheless, and its text counts.
  BOOST_TEST(count("masked") > 100);
  BOOST_TEST(count("hang") > 0);
  BOOST_TEST(count("hang") < 40);
  BOOST_TEST(count("reported") > 0);
  BOOST_TEST(count("unnoticed") > 0);
  BOOST_TEST(campaign.at("all").at("broken") == 0);
  BOOST_TEST(campaign.at("modules").dump().find("pl.axi_dma_0") != std::string::npos);
}

BOOST_FIXTURE_TEST_CASE(a_program_that_sends_again_recovers_from_faults_of_streams, Imported) {
  import();
  const auto counts = [this](const std::string& more) {
    kit::write_file(*this / "c.yaml", "design: mine/design.yaml\nprogram: " MARKERVP_PACKETS
                                      "\ncount: 60\nclasses: stream\n" +
                                          more);
    const kit::Outcome outcome = markervp({"faults", "c.yaml", "--quiet", "-o", "faults"});
    BOOST_TEST(outcome.exit_code == 0, outcome.err);
    return Json::parse(kit::read_file(*this / "faults/faults.json")).at("all");
  };
  const Json noticed = counts("noticed: again\n");
  BOOST_TEST(noticed.at("recovered").get<int>() > 50);
  BOOST_TEST(noticed.at("unnoticed") == 0);
  // Without the key a line more is text that is wrong.
  BOOST_TEST(counts("").at("unnoticed") == noticed.at("recovered"));
}

BOOST_FIXTURE_TEST_CASE(streams_of_other_widths_carry_the_same_bytes, Imported) {
  for (const auto& [stream, memory] : {std::pair{"8", "32"}, {"64", "128"}}) {
    std::string parameters = kit::parameter("C_SG_LENGTH_WIDTH", "20");
    for (const char* name : {"C_M_AXIS_MM2S_TDATA_WIDTH", "C_S_AXIS_S2MM_TDATA_WIDTH"})
      parameters += kit::parameter(name, stream);
    for (const char* name : {"C_M_AXI_MM2S_DATA_WIDTH", "C_M_AXI_S2MM_DATA_WIDTH"})
      parameters += kit::parameter(name, memory);
    write_handoff(replaced(kit::small_handoff().text(), kit::parameter("C_SG_LENGTH_WIDTH", "20"),
                           parameters));
    import();
    const kit::Outcome ran = run_program();
    BOOST_TEST(has(ran.out, "0 bytes wrong, length 101, interrupts 1, buttons 0, own 0"),
               ran.out + ran.err);
    std::filesystem::remove_all(*this / "mine");
  }
}

BOOST_FIXTURE_TEST_CASE(a_chip_of_unknown_figures_gives_way_to_one_that_is_named, Imported) {
  kit::HwhText text = kit::small_handoff();
  text.device = "7z045";
  write_handoff(text.text());
  const kit::Outcome refused = markervp({"import", "small.hwh", "-o", "mine"});
  BOOST_TEST(refused.exit_code == 2);
  BOOST_TEST(has(refused.err,
                 "small.hwh: the design is for an xc7z045clg400-1, whose size, speed "
                 "and power are not known here: --device xc7z020-1"),
             refused.err);
  const kit::Outcome other =
      markervp({"import", "small.hwh", "-o", "mine", "--device", "xc7z100-1"});
  BOOST_TEST(has(other.err, "unknown device 'xc7z100-1'"), other.err);
  const kit::Outcome taken =
      markervp({"import", "small.hwh", "-o", "mine", "--device", "xc7z020-2"});
  BOOST_TEST(taken.exit_code == 0, taken.err);
  BOOST_TEST(has(file("design.yaml"), "device: xc7z020-2"));
  BOOST_TEST(has(file("IMPORT.md"),
                 "* the hand-off is for an xc7z045clg400-1, and was imported as for an xc7z020-2"));
  const kit::Outcome ran = run_program();
  BOOST_TEST(has(ran.out, "0 bytes wrong"), ran.out + ran.err);
}

BOOST_FIXTURE_TEST_CASE(importing_again_keeps_what_the_user_changed, Imported) {
  import();
  kit::write_file(*this / "mine/design.yaml",
                  replaced(file("design.yaml"), "ps.cpu_clk.frequency: 650 MHz",
                           "ps.cpu_clk.frequency: 600 MHz  # as on my board"));
  write_handoff(replaced(kit::small_handoff().text(), "0x41200000", "0x41230000"));
  write_handoff(replaced(kit::read_file(*this / "small.hwh"), "0x4120FFFF", "0x4123FFFF"));
  const kit::Outcome again = import();
  BOOST_TEST(has(again.out, "brought the changes of Vivado into mine/design.yaml and kept yours"),
             again.out + again.err);
  BOOST_TEST(has(file("design.yaml"), "600 MHz  # as on my board"));
  BOOST_TEST(has(file("design.yaml"), "axi_gpio_0.S_AXI: [0x41230000, 64 KiB]"));
  BOOST_TEST(has(import().out, "kept your mine/design.yaml: nothing changed in Vivado"));
  // The same line on both sides.
  write_handoff(replaced(kit::read_file(*this / "small.hwh"), "650.000000", "666.666687"));
  const kit::Outcome conflict = import();
  BOOST_TEST(conflict.exit_code == 2);
  BOOST_TEST(has(conflict.err, "you and Vivado changed the same lines"), conflict.err);
  BOOST_TEST(has(file("design.yaml"), "600 MHz  # as on my board"));
  BOOST_TEST(has(file("design.yaml.new"), "ps.cpu_clk.frequency: 666.666687 MHz"));
}

BOOST_FIXTURE_TEST_CASE(a_program_as_it_is_has_units_of_work, Imported) {
  import();
  const std::string design = file("design.yaml");
  for (const char* end : {"ends: axi_dma_0.s2mm_introut", "line: bytes wrong"}) {
    kit::write_file(*this / "mine/design.yaml", design + "\nwork: {unit: packet, " + end + "}\n");
    const kit::Outcome ran = run_program();
    BOOST_TEST(has(ran.out, "1 packet   ("), ran.out + ran.err);
    BOOST_TEST(has(ran.out, "packets/s mean "), ran.out);
    BOOST_TEST(!has(ran.out, "picture"), ran.out);  // there is nothing to draw
    BOOST_TEST(result().at("frames").size() == 1u);
  }
  kit::write_file(*this / "mine/design.yaml",
                  design + "\nwork: {unit: packet, ends: lines.dout}\n");
  BOOST_TEST(has(run_program().err, "'lines.dout' has several bits"));
}

BOOST_FIXTURE_TEST_CASE(other_commands_take_the_design, Imported) {
  import();
  const kit::Outcome map = markervp({"map", "--design", "mine/design.yaml"});
  BOOST_TEST(map.exit_code == 0, map.err);
  BOOST_TEST(has(map.out, "axi_gpio_0"), map.out);
  const kit::Outcome config = markervp({"config", "pl", "--design", "mine/design.yaml"});
  BOOST_TEST(has(config.out, "length_width: 20"), config.out + config.err);
  const kit::Outcome none = markervp({"run", "--design", "mine/design.yaml"});
  BOOST_TEST(none.exit_code == 2);
  BOOST_TEST(has(none.err, "design 'small' lacks its PS program 'build/small': build"), none.err);
}

// Without Graphviz the page says so.
BOOST_FIXTURE_TEST_CASE(the_page_of_a_run_has_the_block_design, Imported) {
  import();
  run({"--design", "mine/design.yaml", "--program", MARKERVP_IMPORTED});
  const std::string page = kit::read_file(*this / "out/report.html");
  if (kit::run_process("/bin/sh", {"-c", "command -v dot"}, path()).exit_code != 0) {
    BOOST_TEST(has(page, "--diagram needs Graphviz"));
    return;
  }
  const std::size_t at = page.find(R"("diagram":{"svg":"\u003csvg )");
  BOOST_TEST_REQUIRE(at != std::string::npos);
  const std::string diagram = page.substr(at, page.find("\u003c/script", at) - at);
  for (const char* what :
       {R"(>axi_gpio_0\u003c/title)", R"("name":"axi_gpio_0","ip":"xilinx.com:ip:axi_gpio:2.0")",
        R"(["0x41200000","GPIO_DATA","rw",)", R"(["pl.axi_dma_0.m_axi_mm2s.link.bytes_read",101,)",
        R"(["pl.axi_dma_0_M_AXIS_MM2S.beats",26,)"})
    BOOST_TEST(has(diagram, what), what);
  BOOST_TEST(!std::filesystem::exists(*this / "out/diagram.svg"), "it is in the page");
}

BOOST_FIXTURE_TEST_CASE(a_sweep_finds_the_knee_of_a_clock, Imported) {
  import();
  // A stub would leave every verdict open: a GPIO is in the place of own_0.
  std::string design = file("design.yaml");
  for (const auto& [what, by] :
       {std::pair("me:user:own:1.0", "xilinx.com:ip:axi_gpio:2.0"),
        std::pair("    parameters:\n      WIDTH: 8\n", ""), std::pair("s00_axi_aclk", "s_axi_aclk"),
        std::pair("S00_AXI: periph.M02_AXI", "S_AXI: periph.M02_AXI"),
        std::pair("own_0.S00_AXI", "own_0.S_AXI")})
    design = replaced(design, what, by);
  kit::write_file(*this / "mine/design.yaml",
                  design + "\nwork: {unit: packet, line: bytes wrong}\n");
  kit::write_file(*this / "clock.yaml",
                  std::string("title: The clock\nset: {design: mine/design.yaml}\n"
                              "parameters:\n  program: [") +
                      MARKERVP_IMPORTED +
                      "]\n  ps.fclk_clk0.frequency: [80 MHz, 100 MHz, 111.111111 MHz]\n"
                      "  pl.external_buttons.level: [3]\n");
  const kit::Outcome swept = markervp({"sweep", "clock.yaml"});
  BOOST_TEST(swept.exit_code == 0, swept.out + swept.err);
  BOOST_TEST(has(swept.out, "3 of 3 points feasible"), swept.out);
  const kit::Outcome front = markervp({"pareto", "out/clock"});
  BOOST_TEST(front.exit_code == 0, front.out + front.err);
  BOOST_TEST(has(front.out, "knee"), front.out);
  kit::write_file(*this / "wrong.yaml",
                  replaced(kit::read_file(*this / "clock.yaml"), "external_buttons.level",
                           "axi_dma_0.lenght_width"));
  BOOST_TEST(
      has(markervp({"sweep", "wrong.yaml"}).err, "did you mean 'pl.axi_dma_0.length_width'"));
}

BOOST_FIXTURE_TEST_CASE(a_program_is_files_or_the_folder_of_an_application, Imported) {
  const auto with = [&](const std::string& program) {
    return markervp({"import", "small.hwh", "-o", "mine", "--program", program});
  };
  std::filesystem::create_directories(*this / "src/lib");
  BOOST_TEST(has(with("src").err, "no source in C or C++ in 'src'"));
  BOOST_TEST(has(with("main.c").err, "no program source 'main.c'"));
  BOOST_TEST(!std::filesystem::exists(*this / "mine"), "nothing is begun");
  for (const char* name : {"src/main.c", "src/main.h", "src/lscript.ld", "src/lib/more.cpp"})
    kit::write_file(*this / name, "\n");
  BOOST_TEST(with("src").exit_code == 0);
  BOOST_TEST(has(file("CMakeLists.txt"), "  \"../src/lib/more.cpp\"\n  \"../src/main.c\")\n"),
             file("CMakeLists.txt"));
}

BOOST_FIXTURE_TEST_CASE(a_folder_of_the_users_is_left_alone, Imported) {
  import();
  std::filesystem::remove_all(*this / "mine/.import");
  const kit::Outcome again = import();
  BOOST_TEST(again.exit_code == 2);
  BOOST_TEST(has(again.err, "was not written by 'markervp import'"), again.err);
}

BOOST_AUTO_TEST_SUITE_END()
