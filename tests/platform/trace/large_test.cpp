// 200 MB pass through the statistics in constant memory.
#include <sys/resource.h>
#include <vp/wave_writer.h>
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <streambuf>

#include <marker/designs/marker/marker_design.h>
#include <trace/listing.h>
#include <trace/statistics.h>

#include "sanitized.h"
#include "temporary_files.h"

namespace {

/// The most memory this process has had, KiB.
long peak_kib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

BOOST_AUTO_TEST_CASE(memory_does_not_grow_with_the_trace) {
  constexpr std::uint64_t instants = 4'000'000;
  constexpr long allowed_kib = 8 * 1024;
  const kit::TemporaryFolder folder;
  using Kind = vp::WaveWriter::Kind;
  const auto writer = vp::open_wave_writer(folder / "large.vcd");
  writer->add("pl.s.tvalid", Kind::wire, 1);
  writer->add("pl.s.tready", Kind::wire, 1);
  writer->add("pl.s.tdata", Kind::wire, 32);
  writer->add("pl.feature_packaging.corner_count", Kind::wire, 16);
  writer->begin(0, {0, 1, 0, 0});
  std::uint64_t beats = 0;
  for (std::uint64_t i = 1; i < instants; ++i) {
    writer->set_time(i * 10'000);
    writer->change(0, i % 2);
    writer->change(2, static_cast<std::uint32_t>(i * 2654435761u));
    writer->change(3, i % 50);
    beats += i % 2 == 0;
  }
  writer->close(1ull << 50);
  BOOST_TEST(std::filesystem::file_size(folder / "large.vcd") > 200'000'000u);
  const long before = peak_kib();
  platform::trace::TraceFile file(folder / "large.vcd");
  const auto tables = platform::trace::statistics(file, platform::marker_words());
  BOOST_TEST(peak_kib() - before < allowed_kib);
  BOOST_TEST(std::get<std::uint64_t>(tables.front().rows[0][1]) > beats / 2);
}

// A list of strings for the paths alone would take 100 bytes each.
BOOST_AUTO_TEST_CASE(a_million_scopes_take_little_memory) {
  constexpr unsigned scopes = 1'000'000;
  constexpr long allowed_to_ask_kib = 64 * 1024, allowed_to_list_kib = 96 * 1024;
  const kit::TemporaryFolder folder;
  {
    std::ofstream file(folder / "wide.vcd");
    file << "$timescale 1ns $end\n$scope module top $end\n";
    for (unsigned i = 0; i < scopes; ++i) {
      std::string code;
      for (unsigned number = i + 1; number > 0; number = (number - 1) / 94)
        code += static_cast<char>('!' + (number - 1) % 94);
      file << "$scope module u_instance_" << i << " $end\n$var wire 1 " << code
           << " clk $end\n$upscope $end\n";
    }
    file << "$upscope $end\n$enddefinitions $end\n#0\n1!\n#10\n0!\n";
  }
  const long before = peak_kib();
  platform::trace::TraceFile file(folder / "wide.vcd");
  BOOST_TEST(vp::find_path("u_instance_999999.clk", file.paths()) == scopes - 1);
  BOOST_TEST(file.find("top.u_instance_777.clk") == 777);
  if (!kit::is_sanitized) BOOST_TEST(peak_kib() - before < allowed_to_ask_kib);
  struct Count : std::streambuf {
    int overflow(int c) override {
      lines += c == '\n';
      return c;
    }
    unsigned lines = 0;
  } count;
  std::ostream out(&count);
  platform::trace::Listing(file, vp::TraceFilter()).write(out);
  BOOST_TEST(count.lines == scopes + 1);
  if (!kit::is_sanitized) BOOST_TEST(peak_kib() - before < allowed_to_list_kib);
}
