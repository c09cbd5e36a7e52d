// What instructions do with memory. Bytes are those of GNU as.
#include <boost/test/unit_test.hpp>

#include <string>
#include <vector>

#include <chip/linux_app/shim/decode.h>

using shim::MemoryAccess;
using shim::PlainMove;
using Kind = MemoryAccess::Kind;
using Bytes = std::vector<unsigned char>;

namespace {

struct Case {
  const char* text;
  Bytes bytes;
  Kind kind;
  unsigned size;
};

const Case cases[] = {{"mov (%rax),%ecx", {0x8B, 0x08}, Kind::load, 4},
                      {"mov %ecx,(%rax)", {0x89, 0x08}, Kind::store, 4},
                      {"mov %cx,(%rax)", {0x66, 0x89, 0x08}, Kind::store, 2},
                      {"mov %cl,(%rax)", {0x88, 0x08}, Kind::store, 1},
                      {"movb $1,(%rax)", {0xC6, 0x00, 0x01}, Kind::store, 1},
                      {"movw $1,(%rax)", {0x66, 0xC7, 0x00, 0x01, 0x00}, Kind::store, 2},
                      {"movl $1,(%rax)", {0xC7, 0x00, 0x01, 0x00, 0x00, 0x00}, Kind::store, 4},
                      {"movzbl (%rax),%eax", {0x0F, 0xB6, 0x00}, Kind::load, 1},
                      {"movswl (%rax),%eax", {0x0F, 0xBF, 0x00}, Kind::load, 2},
                      {"movslq (%rax),%rax", {0x48, 0x63, 0x00}, Kind::load, 4},
                      {"orl $1,(%rax)", {0x83, 0x08, 0x01}, Kind::both, 4},
                      {"orb $1,(%rax)", {0x80, 0x08, 0x01}, Kind::both, 1},
                      {"and %ecx,(%rax)", {0x21, 0x08}, Kind::both, 4},
                      {"xor (%rax),%ecx", {0x33, 0x08}, Kind::load, 4},
                      {"cmpl $1,(%rax)", {0x83, 0x38, 0x01}, Kind::load, 4},
                      {"cmp %ecx,(%rax)", {0x39, 0x08}, Kind::load, 4},
                      {"testb $1,(%rax)", {0xF6, 0x00, 0x01}, Kind::load, 1},
                      {"test %ecx,(%rax)", {0x85, 0x08}, Kind::load, 4},
                      {"notl (%rax)", {0xF7, 0x10}, Kind::both, 4},
                      {"negw (%rax)", {0x66, 0xF7, 0x18}, Kind::both, 2},
                      {"incl (%rax)", {0xFF, 0x00}, Kind::both, 4},
                      {"shll $3,(%rax)", {0xC1, 0x20, 0x03}, Kind::both, 4},
                      {"imul (%rax),%ecx", {0x0F, 0xAF, 0x08}, Kind::load, 4},
                      {"cmovne (%rax),%ecx", {0x0F, 0x45, 0x08}, Kind::load, 4},
                      {"setne (%rax)", {0x0F, 0x95, 0x00}, Kind::store, 1},
                      {"btl $4,(%rax)", {0x0F, 0xBA, 0x20, 0x04}, Kind::load, 4},
                      {"btsl $4,(%rax)", {0x0F, 0xBA, 0x28, 0x04}, Kind::both, 4},
                      {"rep movsl", {0xF3, 0xA5}, Kind::move, 4},
                      {"rep stosb", {0xF3, 0xAA}, Kind::store, 1},
                      {"movss (%rax),%xmm0", {0xF3, 0x0F, 0x10, 0x00}, Kind::load, 4},
                      {"movd %xmm0,(%rax)", {0x66, 0x0F, 0x7E, 0x00}, Kind::store, 4},
                      {"mov (%rax),%rcx", {0x48, 0x8B, 0x08}, Kind::unsupported, 0},
                      {"movups (%rax),%xmm0", {0x0F, 0x10, 0x00}, Kind::unsupported, 0},
                      {"movdqu (%rax),%xmm0", {0xF3, 0x0F, 0x6F, 0x00}, Kind::unsupported, 0},
                      {"vmovdqu (%rax),%ymm0", {0xC5, 0xFE, 0x6F, 0x00}, Kind::unsupported, 0},
                      {"movq %xmm0,(%rax)", {0x66, 0x0F, 0xD6, 0x00}, Kind::unsupported, 0},
                      {"lock orl $1,(%rax)", {0xF0, 0x83, 0x08, 0x01}, Kind::unsupported, 0},
                      {"xchg %ecx,(%rax)", {0x87, 0x08}, Kind::unsupported, 0},
                      {"cmpxchg %ecx,(%rax)", {0x0F, 0xB1, 0x08}, Kind::unsupported, 0},
                      {"push (%rax)", {0xFF, 0x30}, Kind::unsupported, 0},
                      {"bts %ecx,(%rax)", {0x0F, 0xAB, 0x08}, Kind::unsupported, 0}};

struct Move {
  const char* text;
  Bytes bytes;
  bool store;
  unsigned size, reg, width;
  bool is_signed;
};

// All of them are as long as they are here: bytes behind them would be counted.
const Move moves[] = {
    {"mov (%rax),%ecx", {0x8B, 0x08}, false, 4, 1, 4, false},
    {"mov 8(%rax),%r9d", {0x44, 0x8B, 0x48, 0x08}, false, 4, 9, 4, false},
    {"mov 0x100(%rax),%cx", {0x66, 0x8B, 0x88, 0x00, 0x01, 0x00, 0x00}, false, 2, 1, 2, false},
    {"mov (%rax,%rcx,4),%dl", {0x8A, 0x14, 0x88}, false, 1, 2, 1, false},
    {"mov (%rax),%sil", {0x40, 0x8A, 0x30}, false, 1, 6, 1, false},
    {"mov 0x10(%rip),%eax", {0x8B, 0x05, 0x10, 0x00, 0x00, 0x00}, false, 4, 0, 4, false},
    {"mov 0x1000(,%rcx,4),%eax", {0x8B, 0x04, 0x8D, 0, 0x10, 0, 0}, false, 4, 0, 4, false},
    {"movzbl 4(%rsp),%eax", {0x0F, 0xB6, 0x44, 0x24, 0x04}, false, 1, 0, 4, false},
    {"movsbw (%rax),%cx", {0x66, 0x0F, 0xBE, 0x08}, false, 1, 1, 2, true},
    {"movswq (%rax),%rcx", {0x48, 0x0F, 0xBF, 0x08}, false, 2, 1, 8, true},
    {"movslq (%rax),%rcx", {0x48, 0x63, 0x08}, false, 4, 1, 8, true},
    {"mov %r8d,(%rax)", {0x44, 0x89, 0x00}, true, 4, 8, 0, false},
    {"mov %cl,1(%rax)", {0x88, 0x48, 0x01}, true, 1, 1, 0, false}};

}  // namespace

BOOST_AUTO_TEST_SUITE(decode)

BOOST_AUTO_TEST_CASE(kinds_of_accesses) {
  for (const Case& one : cases) {
    BOOST_TEST_CONTEXT(one.text) {
      const MemoryAccess access = shim::decode(one.bytes.data());
      BOOST_TEST((access.kind == one.kind));
      if (one.kind == Kind::unsupported) {
        BOOST_TEST(access.why != nullptr);
      } else {
        BOOST_TEST(unsigned{access.size} == one.size);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(plain_moves) {
  for (const Move& one : moves) {
    BOOST_TEST_CONTEXT(one.text) {
      PlainMove move{};
      BOOST_TEST_REQUIRE(shim::decode_move(one.bytes.data(), move));
      BOOST_TEST(move.length == one.bytes.size());
      BOOST_TEST(move.is_store == one.store);
      BOOST_TEST(unsigned{move.size} == one.size);
      BOOST_TEST(unsigned{move.reg} == one.reg);
      BOOST_TEST(unsigned{move.width} == one.width);
      BOOST_TEST(move.is_signed == one.is_signed);
      BOOST_TEST(!move.has_number);
    }
  }
}

BOOST_AUTO_TEST_CASE(stores_of_numbers) {
  PlainMove move{};
  const Bytes word{0xC7, 0x40, 0x04, 0x78, 0x56, 0x34, 0x12}, half{0x66, 0xC7, 0x00, 0x34, 0x12};
  BOOST_TEST_REQUIRE(shim::decode_move(word.data(), move));
  BOOST_TEST((move.is_store && move.has_number && move.number == 0x12345678));
  BOOST_TEST(move.length == word.size());
  BOOST_TEST_REQUIRE(shim::decode_move(half.data(), move));
  BOOST_TEST((move.size == 2 && move.number == 0x1234));
  BOOST_TEST(move.length == half.size());
}

BOOST_AUTO_TEST_CASE(what_is_no_plain_move) {
  PlainMove move{};
  for (const Bytes& bytes : {Bytes{0x8A, 0x20} /* mov (%rax),%ah */, Bytes{0x88, 0x38},
                             Bytes{0x48, 0x8B, 0x08}, Bytes{0x83, 0x08, 0x01}, Bytes{0xF3, 0xA5},
                             Bytes{0x0F, 0x10, 0x00}, Bytes{0xF0, 0x89, 0x08}})
    BOOST_TEST(!shim::decode_move(bytes.data(), move));
}

BOOST_AUTO_TEST_SUITE_END()
