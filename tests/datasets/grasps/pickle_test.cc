#include "datasets/grasps/pickle.h"

#include <gtest/gtest.h>

#include "tests/datasets/grasps/grasp_cases.h"

namespace graspbench {
namespace {

std::string ErrorOf(const std::string& bytes) {
  return FindError([&] { ReadPickle(bytes, "p"); });
}

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// By the table of operations in pickletools.py, byte by byte.
TEST(Pickle, PlainValues) {
  const std::string bytes(
      "\x80\x04]("
      "NK\x05J\xfe\xff\xff\xffM\x01\x02\x8a\x02\x00\xffG\x3f\xf0\x00\x00\x00\x00\x00\x00\x88"
      "\x8c\x02"
      "ab\x85}\x8c\x01"
      "kK\x07se.",
      43);
  const Pickle pickle = ReadPickle(bytes, "p");
  const PickleValue& list = *pickle.root;
  ASSERT_EQ(list.kind, PickleValue::Kind::kList);
  ASSERT_EQ(list.items.size(), 9u);
  EXPECT_EQ(list.items[0]->kind, PickleValue::Kind::kNone);
  EXPECT_EQ(list.items[1]->number, 5);
  EXPECT_EQ(list.items[2]->number, -2);
  EXPECT_EQ(list.items[3]->number, 0x201);
  EXPECT_EQ(list.items[4]->number, -256);
  EXPECT_EQ(list.items[5]->number, 1.0);
  EXPECT_EQ(list.items[6]->kind, PickleValue::Kind::kBool);
  EXPECT_EQ(list.items[7]->items[0]->text, "ab");
  EXPECT_EQ(list.items[8]->items[1]->number, 7);
}

TEST(Pickle, OnlyNamesOfNumpy) {
  EXPECT_TRUE(Has(ErrorOf("\x80\x02"
                          "cos\nsystem\n."),
                  "byte 2: the pickle names os.system"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02"
                          "cbuiltins\neval\n."),
                  "builtins.eval"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02"
                          "cnumpy\nload\n."),
                  "numpy.load"));
  // A name that is allowed, split at another place.
  EXPECT_TRUE(Has(ErrorOf("\x80\x02"
                          "cnumpy dtype\n\n."),
                  "which is neither"));
  EXPECT_EQ(ErrorOf("\x80\x02"
                    "cnumpy\ndtype\n."),
            "");
  EXPECT_TRUE(Has(ErrorOf(std::string("\x80\x02"
                                      "cnumpy\nndarray\nK\0\x85R.",
                                      22)),
                  "numpy.ndarray is called directly"));
}

TEST(Pickle, DamagedStack) {
  EXPECT_TRUE(Has(ErrorOf("\x80\x02."), "without its values"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02"
                          "e."),
                  "without its mark"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02NN."), "values left over"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02h\x05."), "value 5 was never remembered"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02NNN}u."), "without its mark"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02}(Nu."), "a key without its value"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x02N"), "0 left"));
  EXPECT_TRUE(Has(ErrorOf("\x80\x06N."), "pickle protocol 6; 2 to 5 are read"));
}

TEST(Pickle, SizesThatLie) {
  EXPECT_TRUE(Has(ErrorOf(std::string("\x80\x04\x8d\xff\xff\xff\xff\xff\xff\xff\xff"
                                      "a.",
                                      13)),
                  "announced, 2 left"));
  // An array of 3 numbers of 8 bytes in 5 bytes.
  const std::string dtype = std::string("cnumpy\ndtype\nX\x02\0\0\0f8\x89\x88\x87R", 24);
  const std::string start(
      "\x80\x02"
      "cnumpy.core.numeric\n_frombuffer\n(",
      35);
  EXPECT_TRUE(Has(ErrorOf(start +
                          "C\x05"
                          "abcde" +
                          dtype + "K\x03\x85X\x01" + std::string(3, '\0') + "CtR."),
                  "an array of 3 elements (8 bytes each) has 5 bytes"));
}

// A few bytes that would otherwise become gigabytes: the same text encoded again and again.
TEST(Pickle, CopiesAreBounded) {
  std::string bytes("\x80\x02X\x00\x10\x00\x00", 7);
  bytes += std::string(4096, 'a') + "q\x01";
  for (int i = 0; i < 3; ++i) {
    bytes += std::string("0c_codecs\nencode\nh\x01X\x06\0\0\0latin1\x86R", 32);
  }
  EXPECT_TRUE(Has(ErrorOf(bytes + "."), "more bytes are encoded than the file holds"));
}

}  // namespace
}  // namespace graspbench
