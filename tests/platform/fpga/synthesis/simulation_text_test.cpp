// What Yosys does not get to see of RTL, and what stays.
#include <fpga/synthesis/simulation_text.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <string>

namespace {

using platform::synthesis::without_simulation;

std::string seen(const std::string& text) {
  const std::string out = without_simulation(text, "ends at 3:");
  BOOST_TEST(std::count(out.begin(), out.end(), '\n') ==
             std::count(text.begin(), text.end(), '\n'));
  return out;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(simulation_text)

BOOST_AUTO_TEST_CASE(a_step_before_its_variable_comes_behind) {
  BOOST_TEST(seen("always @* for (int i = 0; i < 4; ++i) q[i] = a[i];") ==
             "always @* for (int i = 0; i < 4; i++) q[i] = a[i];");
  BOOST_TEST(seen("always @(posedge clk) begin --n; if (a) ++m; else ++k; end") ==
             "always @(posedge clk) begin n--; if (a) m++; else k++; end");
  for (const char* other : {"always @* q = a + +b;", "always @* q = - -b;", "wire c = a ++b;",
                            "always @* if (a) q = 1; /* ++i; */"})
    BOOST_TEST(seen(other) == other);
}

BOOST_AUTO_TEST_CASE(what_prints_becomes_an_empty_statement) {
  BOOST_TEST(seen("always @(posedge clk) if (a) $display(\"(%2d;\", f(b)); else q <= a;") ==
             "always @(posedge clk) if (a) ; else q <= a;");
  BOOST_TEST(seen("initial begin $timeformat(-9, 0,\n \" ns\", 8); mem[0] = 1; end") ==
             "initial begin ;\n mem[0] = 1; end");
}

BOOST_AUTO_TEST_CASE(what_ends_a_simulation_says_its_line) {
  BOOST_TEST(seen("\ninitial\n  if (W < 9) $fatal(1, \"narrow\");\n") ==
             "\ninitial\n  if (W < 9) $display(\"ends at 3:3\");\n");
  BOOST_TEST(seen("initial begin if (W) begin $finish; end end") ==
             "initial begin if (W) begin $display(\"ends at 3:1\"); end end");
}

BOOST_AUTO_TEST_CASE(outside_of_procedures_yosys_knows_them) {
  const std::string generated = "if (W > 9) $error(\"wide\");";
  BOOST_TEST(seen(generated) == generated);
  BOOST_TEST(seen("always @* begin q = d; end " + generated) ==
             "always @* begin q = d; end " + generated);
  BOOST_TEST(seen("always @* case (d) 1: q = 1; default: q = 0; endcase " + generated) ==
             "always @* case (d) 1: q = 1; default: q = 0; endcase " + generated);
  BOOST_TEST(seen("initial if (a) q = 1; else q = 0; " + generated) ==
             "initial if (a) q = 1; else q = 0; " + generated);
  BOOST_TEST(seen("function f(input a); f = a; endfunction " + generated) ==
             "function f(input a); f = a; endfunction " + generated);
}

BOOST_AUTO_TEST_CASE(assertions_go_with_label_and_action) {
  BOOST_TEST(seen("always @* begin assert (a) else $error(\"b;\"); q = a; end") ==
             "always @* begin ; q = a; end");
  BOOST_TEST(
      seen("always @* begin if (b) whole: assert (a) c = 1; else begin c = 0; end q = a; end") ==
      "always @* begin if (b) ; q = a; end");
  BOOST_TEST(
      seen("stays: assert property (@(posedge clk)\n a |=> b) else $error(\"c\"); wire d;") ==
      "\n wire d;");
  BOOST_TEST(seen("always @* case (a) 1: assert (b); default: q = 1; endcase") ==
             "always @* case (a) 1: ; default: q = 1; endcase");
}

BOOST_AUTO_TEST_CASE(comments_strings_and_macros_keep_their_lines) {
  const std::string comment = "// always $display(\"a\");\n/* assert (b); */ wire c;\n";
  BOOST_TEST(seen(comment) == comment);
  BOOST_TEST(
      seen("`define CHECK(x) \\\n  assert property (x) \\\n  else $error(\"y\");\nwire z;") ==
      "`define CHECK(x) \\\n  \\\n\nwire z;");
}

BOOST_AUTO_TEST_SUITE_END()
