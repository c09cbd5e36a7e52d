// FST says the same as VCD.
#include <vp/wave_writer.h>
#include <boost/test/unit_test.hpp>

#include <cstring>
#include <filesystem>

#include "wave_kit.h"

namespace {

using Kind = vp::WaveWriter::Kind;

std::uint64_t pattern(double real) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &real, sizeof bits);
  return bits;
}

void write(const std::string& file) {
  const auto writer = vp::open_wave_writer(file);
  writer->add("top.flag", Kind::wire, 1);
  writer->add("top.word", Kind::reg, 12);
  writer->add("top.watts", Kind::real, 64);
  writer->add("top.state", Kind::text, 1);
  writer->begin(5, {0, 0x123, pattern(1.25), 0});
  writer->set_time(20);
  writer->change(0, 1);
  writer->change(1, 0xFFF);
  writer->change(2, pattern(-0.5));
  writer->change_text(3, "two words \\ more");
  writer->set_time(30);
  writer->pause();
  writer->set_time(40);
  writer->resume({0, 7, pattern(3), 0});
  writer->set_time(50);
  writer->change_digits(1, "x1");
  writer->close(99);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(fst)

// Whether a value is a change depends on what the file holds, however it was written.
BOOST_AUTO_TEST_CASE(values_of_bits_follow_those_of_digits) {
  const kit::TemporaryFolder folder;
  for (const char* name : {"t.vcd", "t.fst"}) {
    const auto writer = vp::open_wave_writer(folder / name);
    writer->add("flag", Kind::wire, 1);
    writer->add("word", Kind::reg, 12);
    writer->add("watts", Kind::real, 64);
    writer->add("late", Kind::wire, 1);
    writer->begin_written(0, {"1", "101", "2.5", std::nullopt});
    writer->set_time(10);
    writer->change(0, 0);
    writer->change(1, 0);
    writer->change(2, pattern(0));
    writer->change(3, 0);
    writer->set_time(20);
    writer->change_digits(0, "1");
    writer->change_digits(1, "1x");
    writer->change_digits(2, "0.5");
    writer->set_time(30);
    writer->change(0, 0);
    writer->change(1, 0);
    writer->change(2, pattern(0));
    writer->set_time(40);
    writer->pause();
    writer->set_time(50);
    writer->change(0, 0);
    writer->close(60);
    const WaveText text(folder / name);
    const auto number = [&](std::uint64_t ps) { return std::stod(text.value("watts", ps)); };
    BOOST_TEST(text.value("late", 10) == "0", name);
    for (const std::uint64_t ps : {10u, 30u}) {
      BOOST_TEST(text.value("flag", ps) == "0", name << " at " << ps);
      BOOST_TEST(std::stoul(text.value("word", ps), nullptr, 2) == 0u, name << " at " << ps);
      BOOST_TEST(number(ps) == 0.0, name << " at " << ps);
    }
    BOOST_TEST(text.value("flag", 20) == "1", name);
    BOOST_TEST(text.value("word", 20).substr(text.value("word", 20).size() - 2) == "1x", name);
    BOOST_TEST(number(20) == 0.5, name);
    BOOST_TEST(text.value("flag", 40) == "x", name);
    BOOST_TEST(text.value("flag", 50) == "0", name);
  }
}

// The same value written again is no change.
BOOST_AUTO_TEST_CASE(the_same_bits_after_digits_are_no_change) {
  const kit::TemporaryFolder folder;
  vp::VcdWriter writer(folder / "t.vcd");
  writer.add("flag", Kind::wire, 1);
  writer.begin_written(0, {"1"});
  writer.set_time(10);
  writer.change(0, 1);
  writer.close(20);
  const std::string written = kit::read_file(folder / "t.vcd");
  BOOST_TEST(written.substr(written.find("#0")) == "#0\n$dumpvars\n1!\n$end\n#20\n");
}

BOOST_AUTO_TEST_CASE(both_formats_say_the_same) {
  const kit::TemporaryFolder folder;
  for (const char* name : {"t.vcd", "t.fst"}) {
    write(folder / name);
    const WaveText text(folder / name);
    BOOST_TEST(text.declared == "top.flag top.word top.watts top.state ");
    BOOST_TEST(text.end_ps == 99u);
    BOOST_TEST(std::stoul(text.value("top.word", 19), nullptr, 2) == 0x123u);
    BOOST_TEST(std::stod(text.value("top.watts", 19)) == 1.25);
    BOOST_TEST(text.value("top.flag", 20) == "1");
    BOOST_TEST(std::stod(text.value("top.watts", 20)) == -0.5);
    BOOST_TEST(text.value("top.state", 20) == "two words \\ more");
    BOOST_TEST(text.value("top.flag", 30) == "x");
    BOOST_TEST(text.value("top.word", 30).front() == 'x');
    BOOST_TEST(text.value("top.watts", 30) == "nan");
    BOOST_TEST(text.value("top.state", 30) == "");
    BOOST_TEST(std::stoul(text.value("top.word", 40), nullptr, 2) == 7u);
    BOOST_TEST(text.value("top.word", 50).find("x1") != std::string::npos);
  }
  BOOST_TEST(folder.entries().size() == 2u);
}

// A block holds 16 MiB of changes; the reader asks for a few signals of many.
BOOST_AUTO_TEST_CASE(blocks_follow_each_other_and_only_what_is_wanted_is_read) {
  const kit::TemporaryFolder folder;
  constexpr unsigned signals = 40, instants = 150'000;
  {
    const auto writer = vp::open_wave_writer(folder / "t.fst");
    for (unsigned i = 0; i < signals; ++i) {
      writer->add("s" + std::to_string(i), Kind::wire, 20 + i);
    }
    writer->begin(0, std::vector<std::uint64_t>(signals, 0));
    for (unsigned at = 1; at < instants; ++at) {
      writer->set_time(at);
      for (unsigned i = 0; i < signals; ++i) writer->change(i, at * (i / 2 + 1));
    }
    writer->close(instants);
  }
  struct Reader : vp::WaveHandler {
    bool at(std::uint64_t ps) override {
      now = ps;
      return true;
    }
    void change(std::uint32_t net, const vp::WaveValue& value) override {
      good = good && net == 7 && value.known && value.bits == now * 4;
      ++changes;
    }
    std::uint64_t now = 0, changes = 0;
    bool good = true;
  } handler;
  vp::WaveReader reader(folder / "t.fst");
  reader.select(7);
  reader.read(handler);
  BOOST_TEST(handler.good);
  BOOST_TEST(handler.changes == instants);
  BOOST_TEST(reader.now_ps() == instants);
}

namespace {

/// Changes of all kinds at uneven times: long silence, and instants in which everything changes.
void write_unevenly(const std::string& file, unsigned instants) {
  constexpr unsigned signals = 300;
  const auto writer = vp::open_wave_writer(file);
  writer->add("go", Kind::wire, 1);
  writer->add("watts", Kind::real, 64);
  writer->add("state", Kind::text, 1);
  writer->add("wide", Kind::wire, 100);
  for (unsigned i = 4; i < signals; ++i)
    writer->add("s" + std::to_string(i), Kind::wire, i % 5 == 0 ? 1 : i % 70 + 1);
  writer->begin(0, std::vector<std::uint64_t>(signals, 0));
  std::uint64_t random = 1;
  const auto next = [&random](unsigned below) {
    random = random * 6364136223846793005u + 1442695040888963407u;
    return static_cast<unsigned>((random >> 33) % below);
  };
  std::uint64_t now = 0;
  for (unsigned i = 0; i < instants; ++i) {
    writer->set_time(now += 1 + next(i % 100 == 0 ? 100'000 : 3));
    writer->change(0, i % 2);
    if (i % 3 == 0) writer->change(1, pattern(next(1000) / 8.0));
    if (i % 7 == 0) writer->change_text(2, "state " + std::to_string(next(50)));
    if (i % 11 == 0) writer->change_digits(3, std::string(next(100), '1') + "0");
    const unsigned many = i % 1000 == 999 ? signals - 4 : next(4);
    for (unsigned k = 0; k < many; ++k) {
      const unsigned signal = 4 + (many > 4 ? k : next(signals - 4));
      if (next(9) == 0) {
        writer->change_digits(signal, "x");
      } else {
        writer->change(signal, next(2));
      }
    }
  }
  writer->close(now + 1);
}

/// What happens to each net, in the order in which it is handed over.
struct Story : vp::WaveHandler {
  explicit Story(const std::string& file, bool texts = true) : texts(texts), reader(file) {
    reader.select_all();
    of_net.resize(reader.nets());
    reader.read(*this);
  }
  bool at(std::uint64_t ps) override {
    BOOST_TEST_REQUIRE((ps >= now));
    now = ps;
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    const unsigned width = reader.variables()[net].width;
    std::string text = std::to_string(now) + " ";
    if (value.kind == vp::WaveVariable::Kind::real) {
      text += std::to_string(value.real);
    } else if (value.plain && width <= 64) {
      text += std::to_string(value.bits);
    } else {
      const std::string digits = vp::full_digits(value.text, width);
      const std::string low = digits.size() > 64 ? digits.substr(digits.size() - 64) : digits;
      if (value.plain) BOOST_TEST_REQUIRE(value.bits == std::stoull(low, nullptr, 2));
      text += digits;
    }
    of_net[net].push_back(text);
  }
  bool needs_texts() const override { return texts; }

  bool texts;
  vp::WaveReader reader;
  std::uint64_t now = 0;
  std::vector<std::vector<std::string>> of_net;
};

}  // namespace

BOOST_AUTO_TEST_CASE(uneven_changes_come_in_the_order_of_their_times) {
  const kit::TemporaryFolder folder;
  constexpr unsigned instants = 150'000;
  for (const char* name : {"t.vcd", "t.fst"}) write_unevenly(folder / name, instants);
  const Story vcd(folder / "t.vcd"), fst(folder / "t.fst"), short_fst(folder / "t.fst", false);
  BOOST_TEST_REQUIRE(vcd.of_net.size() == fst.of_net.size());
  for (std::size_t net = 0; net < vcd.of_net.size(); ++net) {
    BOOST_TEST((vcd.of_net[net] == fst.of_net[net]), "net " << net);
    BOOST_TEST((fst.of_net[net] == short_fst.of_net[net]), "without texts, net " << net);
  }
  BOOST_TEST(vcd.of_net[0].size() > instants / 2);
}

BOOST_AUTO_TEST_CASE(reading_stops_and_goes_on_at_each_instant) {
  const kit::TemporaryFolder folder;
  constexpr unsigned instants = 2000;
  write_unevenly(folder / "t.fst", instants);
  struct Steps : vp::WaveHandler {
    bool at(std::uint64_t) override {
      ++times;
      return false;
    }
    void change(std::uint32_t net, const vp::WaveValue&) override { changes += net == 0; }
    unsigned times = 0, changes = 0;
  } steps;
  vp::WaveReader reader(folder / "t.fst");
  reader.select(0);
  for (unsigned before = 1; before != steps.times;) {
    before = steps.times;
    reader.read(steps);
  }
  BOOST_TEST(steps.times > instants);
  const Story whole(folder / "t.fst");
  BOOST_TEST(steps.changes == whole.of_net[0].size());
}

// Until its writer is done, a file ends with an empty block, and its names are beside it.
BOOST_AUTO_TEST_CASE(an_unfinished_file_is_read_with_its_names) {
  const kit::TemporaryFolder folder;
  write(folder / "t.fst");
  std::string bytes = kit::read_file(folder / "t.fst");
  const auto block_end = [&](std::size_t at) {
    std::size_t length = 0;
    for (std::size_t i = 1; i < 9; ++i) {
      length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
    }
    return at + 1 + length;
  };
  constexpr std::size_t header = 330;
  bytes.resize(block_end(header));
  kit::write_file(folder / "u.fst", bytes + '\xff' + std::string(8, '\0') + "half a block");
  BOOST_CHECK_EXCEPTION(WaveText(folder / "u.fst"), vp::InputError, [](const auto& error) {
    return std::string(error.what()).find("its names are missing") != std::string::npos;
  });
  using namespace std::string_literals;
  const std::string names = "\xfe\0top\0\0"s + "\x10\0flag\0\x01\0"s +
                            "\x05\0word [11:0]\0\x0c\0"s + "\x03\0watts\0\x08\0"s +
                            "\x15\0state\0\0\0"s + "\xff";
  kit::write_file(folder / "u.fst.hier", names);
  const WaveText text(folder / "u.fst");
  BOOST_TEST(text.declared == "top.flag top.word top.watts top.state ");
  BOOST_TEST(std::stoul(text.value("top.word", 40), nullptr, 2) == 7u);
  BOOST_TEST(text.end_ps == 99u);
  BOOST_TEST(!vp::WaveReader(folder / "u.fst").warnings().empty());
}

BOOST_AUTO_TEST_CASE(two_writes_give_the_same_bytes) {
  const kit::TemporaryFolder folder;
  write(folder / "a.fst");
  write(folder / "b.fst");
  BOOST_TEST((kit::read_file(folder / "a.fst") == kit::read_file(folder / "b.fst")));
}

BOOST_AUTO_TEST_CASE(a_truncated_file_is_refused_with_the_byte) {
  const kit::TemporaryFolder folder;
  write(folder / "t.fst");
  const std::size_t size = kit::read_file(folder / "t.fst").size();
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{8}, std::size_t{200}, size - 1}) {
    kit::write_part(folder / "t.fst", folder / "cut.fst", bytes);
    BOOST_CHECK_EXCEPTION(WaveText(folder / "cut.fst"), vp::InputError, [](const auto& error) {
      return std::string(error.what()).find(" at byte ") != std::string::npos;
    });
  }
}

BOOST_AUTO_TEST_CASE(a_file_that_was_not_closed_leaves_nothing_behind_if_nothing_is_in_it) {
  const kit::TemporaryFolder folder;
  vp::open_wave_writer(folder / "t.fst")->add("a", Kind::wire, 1);
  BOOST_TEST(folder.entries().empty());
  BOOST_CHECK_THROW(vp::open_wave_writer("/nowhere/t.fst"), vp::InputError);
  BOOST_CHECK_THROW(vp::open_wave_writer(folder / "t.txt"), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
