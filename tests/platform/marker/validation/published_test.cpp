// The table of published values: what is in it, and what is refused.
#include <marker/validation/published.h>
#include <marker/validation/validation.h>
#include <vp/error.h>

#include <boost/test/unit_test.hpp>
#include <fstream>

#include "synthetic.h"
#include "temporary_files.h"

using namespace platform::validation;

namespace {

constexpr const char* header = "id,section,system,quantity,unit,value,spread,note\n";

std::string refusal(const std::string& text) {
  const kit::TemporaryFolder folder;
  std::ofstream(folder / "published.csv") << text;
  try {
    read_published(folder / "published.csv");
  } catch (const vp::InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(published_values)

BOOST_AUTO_TEST_CASE(values_keep_the_digits_with_which_they_are_printed) {
  const kit::TemporaryFolder folder;
  std::ofstream(folder / "published.csv")
      << header << "a,5.1,both,q,ms,10.340,0.5,n\nb,5,x,q,1,7,,\n";
  const auto rows = read_published(folder / "published.csv");
  BOOST_TEST_REQUIRE(rows.size() == 2u);
  BOOST_TEST(rows[0].value == 10.34);
  BOOST_TEST(rows[0].decimals == 3);
  BOOST_TEST(rows[0].spread.value() == 0.5);
  BOOST_TEST(rows[1].decimals == 0);
  BOOST_TEST(!rows[1].spread.has_value());
}

BOOST_AUTO_TEST_CASE(every_published_value_has_one_rule_and_every_rule_a_value) {
  const auto rows = synthetic::published();
  BOOST_TEST(rows.size() == row_rules().size());
  for (std::size_t i = 0; i < rows.size(); ++i) BOOST_TEST(rows[i].id == row_rules()[i].id);
}

BOOST_AUTO_TEST_CASE(what_a_value_follows_from_is_published) {
  for (const RowRule& rule : row_rules()) {
    for (const std::string& part : rule.follows_from) BOOST_TEST(find_rule(part) != nullptr, part);
  }
}

BOOST_AUTO_TEST_CASE(a_bad_table_is_refused_with_its_line) {
  BOOST_TEST(contains(refusal("id;value\n"), "the first line"));
  BOOST_TEST(contains(refusal(std::string(header) + "a,5.1,both,q,ms,1,\n"), "line 2: it has 7"));
  BOOST_TEST(contains(refusal(std::string(header) + "a,5.1,both,q,ms,1x,,\n"),
                      "line 2: '1x' is not a number"));
  BOOST_TEST(contains(refusal(std::string(header) + "a,5,b,q,ms,1,,\na,5,b,q,ms,1,,\n"),
                      "line 3: 'a' is there twice"));
  BOOST_CHECK_THROW(read_published("/no/such/file.csv"), vp::InputError);
}

BOOST_AUTO_TEST_SUITE_END()
