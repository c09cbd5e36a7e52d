// Entering a trace in the middle: a VCD with the help of its index, an FST at its blocks.
#include <boost/test/unit_test.hpp>

#include <vp/wave_writer.h>

#include <cstdint>

#include "wave_kit.h"

namespace {

/// The values at a time, of a file that is read from an entry or from the front.
class ValuesAt : private vp::WaveHandler {
 public:
  ValuesAt(vp::WaveReader& reader, std::uint64_t ps)
      : reader_(reader), ps_(ps), values_(reader.nets()) {
    reader.select_all();
    reader.read(*this);
  }
  std::vector<std::string> values() const { return values_; }
  std::uint64_t first_ps = UINT64_MAX;

 private:
  bool at(std::uint64_t ps) override {
    if (first_ps == UINT64_MAX) first_ps = ps;
    if (ps > ps_) return false;
    for (const vp::WaveVariable& variable : reader_.variables()) {
      if (variable.is_event) values_[variable.net].clear();  // it is over
    }
    return true;
  }
  void change(std::uint32_t net, const vp::WaveValue& value) override {
    values_[net] = std::string(value.text);
  }
  vp::WaveReader& reader_;
  std::uint64_t ps_;
  std::vector<std::string> values_;
};

struct Found {
  std::vector<std::string> values, warnings;
  std::uint64_t first_ps = 0;
};

Found entered(const std::string& file, std::uint64_t ps, vp::WaveOptions options = {}) {
  options.index_from = 1;
  vp::WaveReader reader(file, options);
  if (const auto entry = reader.entry(ps)) reader.enter(*entry);
  const ValuesAt found(reader, ps);
  return {found.values(), reader.warnings(), found.first_ps};
}

std::vector<std::string> from_the_front(const std::string& file, std::uint64_t ps) {
  vp::WaveReader reader(file);
  return ValuesAt(reader, ps).values();
}

/// A VCD of 3 MB in which everything changes now and then: `nets` vectors, a vector declared bit by
/// bit, a real, a text. In its middle nothing is recorded for a while.
std::string large(unsigned nets) {
  std::string text = "$timescale 1ns $end\n$scope module top $end\n";
  for (unsigned i = 0; i < nets; ++i)
    text += "$var wire 32 n" + std::to_string(i) + "; v" + std::to_string(i) + " $end\n";
  text +=
      "$var event 1 ? go $end\n$var wire 1 ! q [1] $end\n$var wire 1 # q [0] $end\n$var real 64 % "
      "r $end\n"
      "$var string 1 & s $end\n$upscope $end\n$enddefinitions $end\n#1\n1?\n";
  std::uint32_t state = 1;
  const auto next = [&] { return state = state * 1664525 + 1013904223; };
  std::uint64_t time = 5;
  bool gap = true;
  while (text.size() < 3'000'000) {
    text += "#" + std::to_string(time += 1 + next() % 7) + "\n";
    if (gap && text.size() > 1'500'000) {
      text += "$dumpoff\nx! x#\n$end\n#" + std::to_string(++time) + "\n$dumpon\n1!\n$end\n";
      gap = false;
    }
    text += std::to_string(next() >> 31) + (next() % 9 == 0 ? "#\n" : "!\n");
    if (next() % 5 == 0) text += "r" + std::to_string(next() % 1000) + ".5 %\n";
    if (next() % 5000 == 0) text += "sword" + std::to_string(next()) + "\\040more &\n";
    for (unsigned i = 0; i < 4; ++i) {
      text += "b";
      for (unsigned bit = 0; bit < 32; ++bit) text += (next() >> 31) != 0 ? '1' : '0';
      text += " n" + std::to_string(next() % nets) + ";\n";
    }
  }
  return text;
}

bool mentions(const std::vector<std::string>& warnings, const std::string& part) {
  for (const std::string& warning : warnings) {
    if (warning.find(part) != std::string::npos) return true;
  }
  return false;
}

struct File {
  kit::TemporaryFolder folder;
  std::string name = folder / "t.vcd";
  explicit File(const std::string& text) { kit::write_file(name, text); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(wave_index)

BOOST_AUTO_TEST_CASE(the_values_are_those_of_a_reading_from_the_front) {
  // Of 3000 nets, so many change in a mebibyte that the places move apart.
  for (const unsigned nets : {7U, 3000U}) {
    const File file(large(nets));
    bool skipped = false;
    for (const std::uint64_t ps :
         {3'000UL, 40'000'000UL, 50'000'000UL, 53'700'000UL, 80'000'000UL}) {
      const Found found = entered(file.name, ps);
      BOOST_TEST(found.values == from_the_front(file.name, ps), boost::test_tools::per_element());
      skipped = skipped || found.first_ps > 1'000'000;
    }
    BOOST_TEST(skipped);
  }
}

BOOST_AUTO_TEST_CASE(an_index_is_kept_and_used_again) {
  const File file(large(7));
  BOOST_TEST(mentions(entered(file.name, 60'000'000).warnings, "has an index now"));
  const std::string index = kit::read_file(file.name + ".index");
  BOOST_TEST(index.size() < 3'000'000U / 50);
  const Found again = entered(file.name, 60'000'000);
  BOOST_TEST(again.warnings.empty());
  BOOST_TEST(again.first_ps > 1'000'000u);
  BOOST_TEST(kit::read_file(file.name + ".index") == index);
}

BOOST_AUTO_TEST_CASE(an_index_of_another_content_or_a_damaged_one_is_made_anew) {
  const File file(large(7));
  entered(file.name, 60'000'000);
  const std::string other = file.folder / "u.vcd";
  kit::write_file(other, large(9));
  kit::write_file(other + ".index", kit::read_file(file.name + ".index"));
  Found found = entered(other, 60'000'000);
  BOOST_TEST(mentions(found.warnings, "is of another file, or damaged"));
  BOOST_TEST(mentions(found.warnings, "has an index now"));
  BOOST_TEST(found.values == from_the_front(other, 60'000'000), boost::test_tools::per_element());

  std::string damaged = kit::read_file(other + ".index");
  damaged[150] = static_cast<char>(damaged[150] + 1);  // in a place
  kit::write_file(other + ".index", damaged);
  found = entered(other, 60'000'000);
  BOOST_TEST(mentions(found.warnings, "is of another file, or damaged"));
  BOOST_TEST(found.values == from_the_front(other, 60'000'000), boost::test_tools::per_element());

  damaged = kit::read_file(other + ".index");
  damaged.back() = static_cast<char>(damaged.back() + 1);  // in the changes of the last signal
  kit::write_file(other + ".index", damaged);
  BOOST_CHECK_EXCEPTION(entered(other, 60'000'000), vp::InputError, [](const vp::InputError& e) {
    return std::string(e.what()).find("is damaged: remove it") != std::string::npos;
  });
}

BOOST_AUTO_TEST_CASE(it_lies_in_the_cache_if_it_cannot_lie_beside_the_trace) {
  const File file(large(7));
  std::filesystem::create_directory(file.name + ".index");
  ::setenv("XDG_CACHE_HOME", file.folder.path().c_str(), 1);
  const Found found = entered(file.name, 60'000'000);
  BOOST_TEST(mentions(found.warnings, file.folder / "markervp"));
  BOOST_TEST(entered(file.name, 60'000'000).warnings.empty());
  // Without a cache the trace is read from the front.
  std::filesystem::remove_all(file.folder / "markervp");
  kit::write_file(file.folder / "markervp", "");
  const Found without = entered(file.name, 60'000'000);
  ::unsetenv("XDG_CACHE_HOME");
  BOOST_TEST(without.first_ps < 1'000'000u);
  BOOST_TEST(without.values == found.values, boost::test_tools::per_element());
  BOOST_TEST(mentions(without.warnings, "there is no folder for it that can be written"));
}

BOOST_AUTO_TEST_CASE(no_index_is_made_for_what_the_front_answers_sooner) {
  const File file(large(7));
  vp::WaveOptions options;
  options.index_from = 1 << 20;
  const auto ask = [&](std::uint64_t ps) {
    vp::WaveReader reader(file.name, options);
    return reader.entry(ps);
  };
  BOOST_TEST(!ask(10'000'000));  // a tenth of the file's time
  BOOST_TEST(!std::filesystem::exists(file.name + ".index"));
  BOOST_TEST(ask(60'000'000).has_value());
  BOOST_TEST(std::filesystem::exists(file.name + ".index"));
  BOOST_TEST(ask(10'000'000).has_value());  // one that is there is used
  // The same reader may be asked for both.
  std::filesystem::remove(file.name + ".index");
  vp::WaveReader reader(file.name, options);
  BOOST_TEST(!reader.entry(10'000'000));
  BOOST_TEST(reader.entry(60'000'000).has_value());
}

// Else an archive with a trace and a link could replace any file of the user's.
BOOST_AUTO_TEST_CASE(a_file_that_is_no_index_and_a_link_stay_as_they_are) {
  const File file(large(7));
  ::setenv("XDG_CACHE_HOME", file.folder.path().c_str(), 1);
  const std::string own = file.folder / "own.txt";
  kit::write_file(own, "mine");
  std::filesystem::create_symlink(own, file.name + ".index");
  Found found = entered(file.name, 60'000'000);
  BOOST_TEST(mentions(found.warnings, file.folder / "markervp"));
  BOOST_TEST(kit::read_file(own) == "mine");
  std::filesystem::remove(file.name + ".index");
  std::filesystem::remove_all(file.folder / "markervp");
  kit::write_file(file.name + ".index", "my notes on this trace");
  found = entered(file.name, 60'000'000);
  ::unsetenv("XDG_CACHE_HOME");
  BOOST_TEST(mentions(found.warnings, file.folder / "markervp"));
  BOOST_TEST(kit::read_file(file.name + ".index") == "my notes on this trace");
}

BOOST_AUTO_TEST_CASE(what_is_odd_is_known_of_the_whole_file) {
  const File file(large(7) + "#999999999\nbw n1;\n");
  BOOST_TEST(mentions(entered(file.name, 60'000'000).warnings, "begin with a letter"));
  BOOST_TEST(mentions(entered(file.name, 60'000'000).warnings, "begin with a letter"));
  vp::WaveOptions strict;
  strict.strict = true;
  BOOST_TEST(entered(file.name, 60'000'000, strict).first_ps < 1'000'000u);
}

BOOST_AUTO_TEST_CASE(what_comes_before_a_fault_is_read_without_an_index) {
  const File file(large(7) + "#999999999\n1unknown\n");
  const Found found = entered(file.name, 60'000'000);
  BOOST_TEST(found.values == from_the_front(file.name, 60'000'000),
             boost::test_tools::per_element());
  BOOST_TEST(mentions(found.warnings, "is read from the front, as it has no index"));
  BOOST_TEST(!std::filesystem::exists(file.name + ".index"));
}

BOOST_AUTO_TEST_CASE(an_fst_is_entered_at_its_blocks) {
  const kit::TemporaryFolder folder;
  const std::string file = folder / "t.fst";
  {
    const auto writer = vp::open_wave_writer(file);
    const auto wide = writer->add("top.wide", vp::WaveWriter::Kind::wire, 65536);
    const auto rare = writer->add("top.rare", vp::WaveWriter::Kind::wire, 8);
    const auto real = writer->add("top.real", vp::WaveWriter::Kind::real, 0);
    const auto event = writer->add("top.go", vp::WaveWriter::Kind::event, 1);
    writer->begin(0, {0, 5, 0, 0});
    std::string digits(65536, '0');
    for (unsigned i = 1; i < 300; ++i) {
      writer->set_time(i * 1000);
      digits[i] = '1';
      digits[i + 3] = 'x';  // written as it is: 64 KiB each
      writer->change_digits(wide, digits);
      if (i == 100) writer->change(rare, 77);
      if (i == 101) writer->change(real, 0x4004000000000000);
      if (i == 102) writer->change_digits(event, "1");
    }
    writer->close(300'000);
  }
  const Found found = entered(file, 280'500);
  BOOST_TEST(found.first_ps > 200'000u);
  const auto expected = from_the_front(file, 280'500);
  BOOST_TEST(found.values.size() == expected.size());
  BOOST_TEST(found.values[0] == expected[0]);
  BOOST_TEST(vp::full_digits(found.values[1], 8) == "01001101");
  BOOST_TEST(found.values[2] == "2.5");
  BOOST_TEST(found.values[3] == "", "an event of an earlier block is over");
  BOOST_TEST(entered(file, 50'500).values[0] == from_the_front(file, 50'500)[0]);
}

BOOST_AUTO_TEST_SUITE_END()
