// The table of rules: each name once, and each in the documentation with what it says.
#include <boost/test/unit_test.hpp>

#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <vp/protocol_rules.h>

BOOST_AUTO_TEST_CASE(each_rule_is_documented_once) {
  std::ifstream file(MARKERVP_TEST_DATA "/../../docs/rules.md");
  std::ostringstream text;
  text << file.rdbuf();
  std::set<std::string> names;
  for (std::size_t i = 0; i < vp::rule_count; ++i) {
    const vp::RuleInfo& rule = vp::info_of(static_cast<vp::Rule>(i));
    BOOST_TEST(names.insert(rule.name).second, rule.name);
    const std::string row = std::string("| `") + rule.name + "` | " + rule.statement + " |";
    BOOST_TEST(text.str().find(row) != std::string::npos, row);
  }
}

BOOST_AUTO_TEST_CASE(both_address_channels_have_the_same_rules) {
  for (auto i = static_cast<unsigned>(vp::Rule::aw_addr_boundary);
       i < static_cast<unsigned>(vp::Rule::ar_addr_boundary); ++i) {
    const auto of_aw = static_cast<vp::Rule>(i);
    std::string name = vp::info_of(of_aw).name;
    name.replace(name.find("_AW"), 3, "_AR");
    BOOST_TEST(vp::info_of(vp::on_ar(of_aw)).name == name);
  }
}
