// SPDX-License-Identifier: BSD-3-Clause
// GenoM's own part of a description.
#include "tests/modules/description/described.hpp"

namespace waitpoint::description {
namespace {

const char* const demo = R"gen(
/* A mobile on a rail. */
module demo {
  number: 9000; internal_data: DEMO_STR; version: "0.1"; email: "demo@example.org"; clock_rate: 200; lang: "c++";
  requires: pocolibs, some-lib;
};
import from loco {
)gen"
                         "#include \"locoStruct.h\"\n"
                         R"gen(};
typedef enum DEMO_SPEED { DEMO_SLOW, DEMO_FAST } DEMO_SPEED;
typedef struct DEMO_STATE_STR { double position; double speed; } DEMO_STATE_STR;
typedef struct DEMO_STR { DEMO_STATE_STR state; DEMO_SPEED speedRef; double distRef; char name[16]; } DEMO_STR;

request SetSpeed {
  type: control;
  input: speed::speedRef;
  input_info: DEMO_FAST::"the speed " "of moves";
  codel_control: demoSetSpeedCntrl;
  fail_reports: INVALID_SPEED;
};
request Stop { type: control; interrupt_activity: all; };
request Goto {
  doc: "moves by a distance";
  type: exec;
  exec_task: MotionTask;
  input: distance::distRef;
  input_info: -1.5e1::"distance (m)";
output : position::state.position;
c_control_func : demoGotoCntrl;
codel_start : demoGotoStart;
c_exec_func : demoGotoMain;
codel_end : demoGotoEnd;
codel_inter : demoGotoInter;
fail_msg : TOO_FAR_AWAY, INVALID_SPEED;
incompatible_with : Goto;
posters_input : LOCO_REF;
};
poster Mobile {
update:
  auto;
data:
  state::state, ref::distRef;
exec_task:
  MotionTask;
};
poster Ref {
update:
  user;
type:
  ref::LOCO_REF;
exec_task:
  Planner;
};
exec_task MotionTask {
period:
  2 * 5;
delay:
  5;
priority:
  100;
stack_size:
  2000;
c_init_func:
  demoInit;
codel_task_main:
  demoMain;
fail_reports:
  NO_RAIL;
poster_client_from:
  loco::Position;
cs_client_from:
  loco;
};
exec_task Planner {
period:
  none;
priority:
  200;
stack_size:
  2000;
codel_task_wait:
  demoWait;
};
)gen";
const Files headers = {{"locoStruct.h", "typedef struct LOCO_REF { float v; } LOCO_REF;"}};

TEST(Description, HasWhatTheFileDeclares) {
  const Description found = described(demo, headers);
  EXPECT_EQ(found.name.text, "demo");
  EXPECT_EQ(found.number, 9000);
  EXPECT_EQ(found.ticks_per_s, 200);
  EXPECT_TRUE(found.cxx_codels);
  EXPECT_EQ(found.packages, (std::vector<std::string>{"pocolibs", "some-lib"}));
  EXPECT_EQ(found.imports, std::vector<std::string>{"loco"});
  EXPECT_EQ(found.reports, (std::vector<std::string>{"INVALID_SPEED", "TOO_FAR_AWAY", "NO_RAIL"}));
  ASSERT_EQ(found.declarations.size(), 4U);
  EXPECT_EQ(found.declarations[0], "#include \"locoStruct.h\"");
  EXPECT_EQ(found.declarations[1], "typedef enum DEMO_SPEED { DEMO_SLOW, DEMO_FAST } DEMO_SPEED;");
}

TEST(Description, HasRequestsWithResolvedTypes) {
  const Description found = described(demo, headers);
  ASSERT_EQ(found.requests.size(), 3U);
  const Request& speed = found.requests[0];
  EXPECT_EQ(speed.kind, RequestKind::control);
  EXPECT_EQ(structure(*speed.input->type), "enum(u32)");
  ASSERT_EQ(speed.input_infos.size(), 1U);
  EXPECT_EQ(speed.input_infos[0].value, "1");
  EXPECT_EQ(speed.input_infos[0].text, "the speed of moves");
  const Request& go = found.requests[2];
  EXPECT_EQ(go.doc, "moves by a distance");
  EXPECT_EQ(go.exec_task->text, "MotionTask");
  EXPECT_EQ(go.input_infos[0].value, "-1.5e1");
  EXPECT_EQ(path_text(*go.output), "state.position");
  EXPECT_EQ(structure(*go.output->type), "f64");
  EXPECT_EQ(go.control + go.start + go.main + go.end + go.inter,
            "demoGotoCntrldemoGotoStartdemoGotoMaindemoGotoEnddemoGotoInter");
  ASSERT_EQ(go.interrupts.size(), 1U);
  EXPECT_EQ(go.posters_input, std::vector<std::string>{"LOCO_REF"});
  ASSERT_EQ(found.requests[1].interrupts.size(), 1U) << "'all' are the requests with activities";
  EXPECT_EQ(found.requests[1].interrupts[0].text, "Goto");
}

TEST(Description, HasPostersAndTasks) {
  const Description found = described(demo, headers);
  ASSERT_EQ(found.posters.size(), 2U);
  EXPECT_EQ(poster_type_name(found, found.posters[0]), "DEMO_MOBILE_POSTER_STR");
  EXPECT_EQ(structure(*poster_type(found, found.posters[0])), "{state: {position: f64, speed: f64}, ref: f64}");
  EXPECT_EQ(structure(*poster_type(found, found.posters[1])), "{ref: {v: f32}}");
  ASSERT_EQ(found.tasks.size(), 2U);
  EXPECT_EQ(found.tasks[0].period_ticks, 10);
  EXPECT_EQ(found.tasks[0].delay_ticks, 5);
  EXPECT_EQ(found.tasks[0].start, "demoInit");
  EXPECT_EQ(found.tasks[0].reads, std::vector<std::string>{"loco.Position"});
  EXPECT_EQ(found.tasks[1].period_ticks, std::nullopt);
}

TEST(Description, IsRefusedAtLineAndColumn) {
  const std::string task = "exec_task Motion { period: 1; priority: 1; stack_size: 1; };\n";
  EXPECT_EQ(refusal(""),
            "demo.gen:1: column 1: expected a declaration 'module NAME { ... };', found the end of the file");
  EXPECT_EQ(refusal("module demo { number: 9000; };"),
            "demo.gen:1: column 8: expected the typedef of a struct for internal_data");
  EXPECT_EQ(refusal("module demo { number 9000; };"),
            "demo.gen:1: column 22: expected ':' behind 'number', found '9000'");
  EXPECT_EQ(refusal("module demo { number: 40000; };"),
            "demo.gen:1: column 23: expected a module's number from 1 to 32767, found 40000");
  EXPECT_EQ(refusal(module_with("int a;", "request Go { tpye: exec; };")),
            "demo.gen:3: column 14: expected an attribute of a request, found 'tpye', did you mean 'type'?");
  EXPECT_EQ(refusal(module_with("int a;", "request Go { type: exec; exec_task: Motoin; codel_main: f; };\n" + task)),
            "demo.gen:3: column 37: expected an exec_task of this module, found 'Motoin', did you mean 'Motion'?");
  EXPECT_EQ(refusal(module_with("int a;", "request Go { type: control; input: x::b; };")),
            "demo.gen:3: column 36: expected a member of DEMO_STR, found 'b' in 'x::b'");
  EXPECT_EQ(refusal(module_with("int a;", "request Go { type: exec; exec_task: Motion; };\n" + task)),
            "demo.gen:3: column 9: expected codel_start, codel_main or codel_end of 'Go'");
  EXPECT_EQ(refusal(module_with("int a;", "request Go { type: control; interrupt_activity: Went; };")),
            "demo.gen:3: column 49: expected a request of this module, found 'Went'");
  EXPECT_EQ(
      refusal(module_with("int a[300];", "request Go { type: control; input: x::a; };")),
      "demo.gen:3: column 36: expected an input or output of at most 1024 bytes, found 2400 (larger values are for "
      "posters)");
  EXPECT_EQ(refusal(module_with("int a;", "request Abort { type: control; };")),
            "demo.gen:3: column 9: expected requests of different names, found 'Abort' again");
  EXPECT_EQ(refusal(module_with("struct { int b; } a;", "request Go { type: control; input: x::a; };")),
            "demo.gen:3: column 36: expected a member whose type has a name, found 'a'");
  EXPECT_EQ(
      refusal(module_with("int a;",
                          "request A { type: control; codel_control: f; };\n"
                          "request B { type: control; input: x::a; codel_control: f; };")),
      "demo.gen:4: column 9: expected other codels than another request's with another input or output, found 'f' in "
      "'B'");
  EXPECT_EQ(refusal(module_with("int a;", "poster P { update: often; };")),
            "demo.gen:3: column 20: expected 'user' or 'auto', found 'often'");
  EXPECT_EQ(refusal(module_with("int a;", "request Go { type: control; type: control; };")),
            "demo.gen:3: column 29: expected 'type' once");
  EXPECT_EQ(
      refusal(module_with("int a, b;", "request Go { type: control; input: x::a; input_info: 1::\"a\", 2::\"b\"; };")),
      "demo.gen:3: column 62: expected input_info for each of the 1 numbers and texts of the input, found 2");
}

/// Constants that each have the one before twice, with `separator` between: A59 has it 2^59 times.
std::string doubling_constants(const std::string& first, const std::string& separator) {
  std::string text = "#define A0 " + first + "\n";
  for (int i = 1; i < 60; ++i) {
    const std::string before = " A" + std::to_string(i - 1);
    text += "#define A" + std::to_string(i) + before + separator + before + "\n";
  }
  return text;
}

TEST(Description, IsRefusedForConstantsThatMultiply) {
  const std::string expected = "expected at most 200000 words of constants in place of their names";
  EXPECT_EQ(refusal(doubling_constants("", "") + "A59\n"), "demo.gen:61: column 1: " + expected);
  const std::string condition = refusal(doubling_constants("1", "|") + "#if A59\n#endif\n");
  EXPECT_NE(condition.find(expected), std::string::npos) << condition;
}

TEST(Description, IsRefusedForKeywordsAsNames) {
  const std::string keyword = ", found the keyword 'class' of C or C++";
  EXPECT_EQ(refusal(module_with("int class;")), "demo.gen:2: column 31: expected the name of a member" + keyword);
  EXPECT_EQ(refusal("module class { number: 9000; };"),
            "demo.gen:1: column 8: expected the name of a module" + keyword);
  EXPECT_EQ(refusal(module_with("int a;", "request Go { type: control; codel_control: class; };")),
            "demo.gen:3: column 44: expected the name of a codel" + keyword);
  EXPECT_EQ(refusal("enum class { RED };"), "demo.gen:1: column 6: expected the name of an enum" + keyword);
  EXPECT_EQ(refusal("enum { class };"), "demo.gen:1: column 8: expected the name of an enumerator" + keyword);
  EXPECT_EQ(refusal(module_with("int class_, klass;")), "");
}

}  // namespace
}  // namespace waitpoint::description
