// The kinds of input that the platform has: none, and files of samples.
#include <study/inputs.h>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include <vp/file.h>

#include "sweep_kit.h"
#include "temporary_files.h"

using namespace platform;
using study::InputRequest;
using sweep_test::complaint;
using sweep_test::contains;

namespace {

const facts::InputNeed blocks{"samples", 4};

std::vector<std::string> names_of(facts::InputSource& source) {
  std::vector<std::string> names;
  while (const facts::SharedInput input = source.next()) names.push_back(input->name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

BOOST_AUTO_TEST_SUITE(inputs)

BOOST_AUTO_TEST_CASE(units_that_bring_nothing) {
  const auto one = study::open_inputs({});
  BOOST_TEST_REQUIRE(one->next() != nullptr);
  BOOST_TEST(one->next() == nullptr);
  BOOST_TEST(!one->size().has_value(), "the program may deliver more");
  InputRequest three;
  three.limit = 3;
  const auto units = study::open_inputs(three);
  const facts::SharedInput unit = units->next();
  BOOST_TEST(unit->bytes().empty());
  BOOST_TEST(unit->width() == 0u);
  BOOST_TEST(!unit->settles_after(nullptr));
  BOOST_TEST(names_of(*units).size() == 2u);
  BOOST_TEST(study::contents_of({}).empty());
  BOOST_TEST(contains(complaint([] {
                        study::open_inputs({{"demo"}, {}});
                      }),
                      "takes no input: leave out 'demo'"));
  BOOST_TEST(contains(complaint([] { study::contents_of({{"demo"}, {}}); }), "takes no input"));
}

BOOST_AUTO_TEST_CASE(files_in_blocks) {
  const kit::TemporaryFolder folder;
  const std::string a = folder / "a.bin", b = folder / "b.bin";
  vp::write_file(a, "abcdefgh");
  vp::write_file(b, "WXYZ");
  InputRequest request{{a, b}, {}, blocks};
  const auto source = study::open_inputs(request);
  BOOST_TEST(*source->size() == 3u);
  const facts::SharedInput first = source->next();
  BOOST_TEST(first->name == "a.bin#1");
  BOOST_TEST(std::string(first->bytes().begin(), first->bytes().end()) == "abcd");
  BOOST_TEST(first->width() == 4u);
  BOOST_TEST(first->height() == 1u);
  BOOST_TEST(names_of(*source) == (Names{"a.bin#2", "b.bin#1"}), boost::test_tools::per_element());
  request.repeat = 2;
  request.limit = 5;
  const auto repeated = study::open_inputs(request);
  BOOST_TEST(*repeated->size() == 5u);
  BOOST_TEST(names_of(*repeated) == (Names{"a.bin#1", "a.bin#2", "b.bin#1", "a.bin#1", "a.bin#2"}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(contents_follow_the_bytes) {
  const kit::TemporaryFolder folder;
  const std::string file = folder / "a.bin";
  vp::write_file(file, "abcd");
  const auto before = study::contents_of({{file}, {}, blocks});
  BOOST_TEST(before == study::contents_of({{file}, {}, blocks}));
  vp::write_file(file, "abce");
  BOOST_TEST(before != study::contents_of({{file}, {}, blocks}));
}

BOOST_AUTO_TEST_CASE(what_makes_no_whole_blocks_is_refused) {
  const kit::TemporaryFolder folder;
  const std::string file = folder / "odd.bin";
  vp::write_file(file, "abcde");
  BOOST_TEST(contains(complaint([&] {
                        study::open_inputs({{file}, {}, blocks});
                      }),
                      "5 bytes are no whole number of blocks: the design takes blocks of 4 bytes"));
  vp::write_file(file, "");
  BOOST_TEST(contains(complaint([&] { study::open_inputs({{file}, {}, blocks}); }), "0 bytes"));
  BOOST_TEST(contains(complaint([&] {
                        study::open_inputs({{}, {}, blocks});
                      }),
                      "name a file of samples"));
  BOOST_TEST(contains(complaint([&] {
                        study::open_inputs({{folder / "no.bin"}, {}, blocks});
                      }),
                      "no.bin"));
  BOOST_TEST(contains(complaint([&] {
                        study::open_inputs({{folder.path()}, {}, blocks});
                      }),
                      "cannot read samples"));
}

BOOST_AUTO_TEST_CASE(unknown_kinds_and_settings_are_refused) {
  BOOST_TEST(contains(complaint([] {
                        study::open_inputs({{}, {}, {"sounds", 4}});
                      }),
                      "no inputs of the kind 'sounds': it has "));
  BOOST_TEST(contains(complaint([] {
                        study::open_inputs({{}, {{"fit", "crop"}}});
                      }),
                      "'fit' does not apply: this design takes no input"));
  BOOST_TEST(contains(complaint([] { study::contents_of({{}, {{"fit", "crop"}}}); }), "'fit'"));
}

BOOST_AUTO_TEST_SUITE_END()
