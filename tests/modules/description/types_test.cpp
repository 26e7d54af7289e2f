// SPDX-License-Identifier: BSD-3-Clause
// C types: what is accepted, and its layout, which is the compiler's.
#include <cstddef>
#include <cstdint>

#include "tests/modules/description/described.hpp"

namespace waitpoint::description {
namespace {

// The same declarations for the compiler and for the description.
#define WAITPOINT_TYPES                                \
  enum COLOUR { RED, GREEN = 7, BLUE, NEGATIVE = -2 }; \
  typedef struct POINT {                               \
    double x, y;                                       \
  } POINT;                                             \
  typedef char LABEL[13];                              \
  typedef struct {                                     \
    char mark;                                         \
    unsigned long long int ticks;                      \
    short table[2][3];                                 \
    POINT corners[3];                                  \
    LABEL label;                                       \
    enum COLOUR colour;                                \
    struct {                                           \
      float ratio;                                     \
      unsigned char flags;                             \
    } inner;                                           \
    signed char last;                                  \
  } ALL;
#define WAITPOINT_TEXT(...) #__VA_ARGS__
#define WAITPOINT_TEXT_OF(x) WAITPOINT_TEXT(x)

namespace compiled {
WAITPOINT_TYPES
}  // namespace compiled

TEST(DescribedType, IsLaidOutAsByTheCompiler) {
  const Description description =
      described(std::string(WAITPOINT_TEXT_OF(WAITPOINT_TYPES)) + "\n" + module_with("ALL all_of_it;"));
  const Type& type = member(description, "all_of_it");
  EXPECT_EQ(type.size, sizeof(compiled::ALL));
  EXPECT_EQ(type.alignment, alignof(compiled::ALL));
  const std::pair<const char*, std::size_t> offsets[] = {
      {"mark", offsetof(compiled::ALL, mark)},   {"ticks", offsetof(compiled::ALL, ticks)},
      {"table", offsetof(compiled::ALL, table)}, {"corners", offsetof(compiled::ALL, corners)},
      {"label", offsetof(compiled::ALL, label)}, {"colour", offsetof(compiled::ALL, colour)},
      {"inner", offsetof(compiled::ALL, inner)}, {"last", offsetof(compiled::ALL, last)}};
  for (const auto& [name, offset] : offsets) EXPECT_EQ(find_field(type, name)->offset, offset) << name;
  EXPECT_EQ(
      structure(type),
      "{mark: char, ticks: u64, table: [2][3]i16, corners: [3]{x: f64, y: f64}, label: text[13], colour: enum(i32), "
      "inner: {ratio: f32, flags: u8}, last: i8}");
  const std::vector<Enumerator>& colours = find_field(type, "colour")->type->enumerators;
  ASSERT_EQ(colours.size(), 4U);
  EXPECT_EQ(colours[2].value, compiled::BLUE);
}

TEST(DescribedType, HasTheNumbersOfC) {
  const Description description = described(module_with(
      "int a; unsigned b; long c; unsigned long int d; short int e; uint16_t f; bool g; _Bool h; size_t i;"));
  EXPECT_EQ(structure(*description.data), "{a: i32, b: u32, c: i64, d: u64, e: i16, f: u16, g: bool, h: bool, i: u64}");
  EXPECT_EQ(description.data->size, 40U);
}

TEST(DescribedType, MayHaveSizesFromConstants) {
  const Description description =
      described("#define ROWS 4\n#define COLUMNS (ROWS * 2 + 1)\nenum { DEPTH = 1 << 2 };\n" +
                module_with("int a[COLUMNS]; int b[DEPTH - 1][sizeof(double)]; int c['A' == 65 ? 0x10 : 010];"));
  EXPECT_EQ(structure(*description.data), "{a: [9]i32, b: [3][8]i32, c: [16]i32}");
}

TEST(DescribedType, ComesFromIncludedHeaders) {
  const Files files = {{"inc/demoStruct.h",
                        "#ifndef DEMO_STRUCT_H\n#define DEMO_STRUCT_H\n#include <stdint.h>\n#include \"parts/part.h\"\n"
                        "#ifdef __cplusplus\nextern \"C\" {\n#endif\n"
                        "extern int *demoFind(const char *name);\nstatic inline int twice(int x) { return x * 2; }\n"
                        "typedef struct DEMO_STATE_STR { PART part; } DEMO_STATE_STR;\n"
                        "#ifdef __cplusplus\n}\n#endif\n#endif\n"},
                       {"inc/parts/part.h",
                        "#if defined(WIDE) && WIDE > 1\ntypedef double PART;\n#else\ntypedef float PART;\n#endif\n"}};
  const std::string text =
      "#include \"demoStruct.h\"\n#include \"demoStruct.h\"\n" + module_with("DEMO_STATE_STR state;");
  EXPECT_EQ(structure(*described(text, files, {"inc"}).data), "{state: {part: f32}}");
  EXPECT_EQ(structure(*described("#define WIDE 2\n" + text, files, {"inc"}).data), "{state: {part: f64}}");
  EXPECT_EQ(refusal(text, files), "demo.gen:1: column 10: expected a file to include, found no 'demoStruct.h'");
}

TEST(DescribedType, WithoutMeaningElsewhereIsRefused) {
  EXPECT_EQ(
      refusal(module_with("double *p;")),
      "demo.gen:2: column 34: expected the name of a member (pointers and functions mean nothing in another process), "
      "found '*'");
  EXPECT_EQ(
      refusal(module_with("union { int a; } u;")),
      "demo.gen:2: column 27: expected a struct, an enum or a number (a union's content is unknown to others), found "
      "'union'");
  EXPECT_EQ(refusal(module_with("int a : 3;")),
            "demo.gen:2: column 33: expected a member without a width (a bit-field has no address), found ':'");
  EXPECT_EQ(refusal(module_with("long double a;")),
            "demo.gen:2: column 27: expected a number of C (no long double), found 'long double'");
}

TEST(DescribedType, InvalidIsRefusedAtItsPlace) {
  EXPECT_EQ(refusal(module_with("doubel x;")),
            "demo.gen:2: column 27: expected a type, found the unknown name 'doubel'");
  EXPECT_EQ(refusal("typedef struct POINT { double x; } POINT;\n" + module_with("POIMT x;")),
            "demo.gen:3: column 27: expected a type, found the unknown name 'POIMT', did you mean 'POINT'?");
  EXPECT_EQ(refusal(module_with("int a[0];")),
            "demo.gen:2: column 32: expected an array of at least 1 element, found 0");
  EXPECT_EQ(refusal(module_with("int a[1 / 0];")), "demo.gen:2: column 35: expected a divisor other than this");
  EXPECT_EQ(refusal(module_with("int a[1 << 30][8];")),
            "demo.gen:2: column 32: expected an array of 1 element to 1 GiB");
  EXPECT_EQ(refusal(module_with("int a, a;")),
            "demo.gen:2: column 34: expected members of different names, found 'a' again");
  EXPECT_EQ(refusal("/* no end"),
            "demo.gen:1: column 1: expected '*/' at the end of this comment, found the end of the file");
  EXPECT_EQ(refusal("#if 1\n"), "demo.gen:1: column 2: expected '#endif' for this condition");
  EXPECT_EQ(refusal("#include \"demo.h\"\n", {{"demo.h", "#include \"demo.h\"\n"}}),
            "demo.h:1: column 2: expected files included at most 32 deep");
}

}  // namespace
}  // namespace waitpoint::description
