// SPDX-License-Identifier: BSD-3-Clause
// Launch files that are wrong: one line each, with file and line.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/modules/ros1/launch_text.hpp"

namespace waitpoint::ros1 {
namespace {

class LaunchErrors : public LaunchTexts {};

TEST_F(LaunchErrors, RefuseUnknownElementsAndAttributes) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"xml(<nod pkg="p" type="t" name="n"/>)xml", "unknown element <nod> in <launch>, did you mean 'node'?"},
      {R"xml(<group><zzzzz/></group>)xml",
       "unknown element <zzzzz> in <group>, expected node, test, param, rosparam, remap, env, group, arg or include"},
      {R"xml(<node pkg="p" typ="t" name="n"/>)xml", "unknown attribute 'typ' of <node>, did you mean 'type'?"},
      {R"xml(<remap from="a" onto="b"/>)xml", "unknown attribute 'onto' of <remap>, expected from, to, if or unless"},
      {R"xml(<node pkg="p" type="t" name="n"><group/></node>)xml",
       "unknown element <group> in <node>, expected param, rosparam, remap or env"},
      {R"xml(<machine name="m" address="a"/>)xml",
       "expected no <machine>: all nodes of a simulation have one machine and its master"},
      {R"xml(<node pkg="p" name="n"/>)xml", "expected the attribute 'type' of <node>, found none"},
      {R"xml(<node pkg="p" type="" name="n"/>)xml", "expected the attribute 'type' of <node>, found none"},
      {R"xml(<param value="1"/>)xml", "expected the attribute 'name' of <param>, found none"},
      {R"xml(<env name="E"/>)xml", "expected the attribute 'value' of <env>, found none"},
      {R"xml(<env name="E=F" value="1"/>)xml", "expected the name of a variable in <env>, found 'E=F'"},
      {R"xml(<include/>)xml", "expected the attribute 'file' of <include>, found none"},
      {R"xml(<test pkg="p" type="t"/>)xml", "expected the attribute 'test-name' of <test>, found none"},
  };
  for (const auto& [elements, expected] : cases) EXPECT_EQ(complaint_about(elements), "a.launch:2: " + expected);
}

TEST_F(LaunchErrors, RefuseFeaturesThatASimulationLacks) {
  const std::string node = R"xml(<node pkg="p" type="t" name="n" )xml";
  EXPECT_EQ(complaint_about(node + R"xml(respawn="true"/>)xml"),
            "a.launch:2: expected no respawn: a node that ends is a result of the run, not started again");
  EXPECT_EQ(
      complaint_about(node + R"xml(launch-prefix="gdb"/>)xml"),
      "a.launch:2: expected no 'launch-prefix': nodes are started in the simulation, `waitpoint explore` and `gdb` "
      "are for the whole of it");
  EXPECT_EQ(complaint_about(node + R"xml(machine="m"/>)xml"),
            "a.launch:2: expected no 'machine': all nodes of a simulation have one");
  EXPECT_EQ(complaint_about(R"xml(<param name="d" command="xacro r.xacro"/>)xml"),
            "a.launch:2: expected no 'command' of <param>: nothing is executed while a launch file is read; save the "
            "command's output, and give it as 'textfile'");
  EXPECT_EQ(complaint_about(R"xml(<rosparam command="delete" param="x"/>)xml"),
            "a.launch:2: expected 'command' of <rosparam> to be load, found 'delete'");
}

TEST_F(LaunchErrors, CheckValuesOfAttributes) {
  const std::string node = R"xml(<node pkg="p" type="t" )xml";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {node + R"xml(name="a/b"/>)xml",
       "expected the name of a node to be of letters, digits and '_', found 'a/b'; namespaces are in 'ns'"},
      {node + R"xml(name="1st"/>)xml", "expected the name of a node to be of letters, digits and '_', found '1st'"},
      {node + R"xml(name="n" output="both"/>)xml", "expected 'output' of <node> to be log or screen, found 'both'"},
      {node + R"xml(name="n" cwd="here"/>)xml",
       "expected 'cwd' of <node> to be ROS_HOME, node or ros_home, found 'here'"},
      {node + R"xml(name="n" required="maybe"/>)xml",
       "expected 'required' of <node> to be true or false, found 'maybe'"},
      {node + R"xml(name="n" args="it's"/>)xml", "expected a closing quote in 'args' of <node>, found 'it's'"},
      {R"xml(<group ns="a b"/>)xml", "expected 'ns' of <group> to be a namespace, found 'a b'"},
      {R"xml(<group ns="~p"/>)xml", "expected 'ns' of <group> to be a namespace, found '~p'"},
      {R"xml(<group clear_params="true"/>)xml", "expected 'ns' of a <group> that has 'clear_params'"},
      {R"xml(<group if="2"/>)xml", "expected 'if' of <group> to be true, 1, false or 0, found '2'"},
      {R"xml(<group if="1" unless="1"/>)xml", "expected 'if' or 'unless' in <group>, found both"},
      {R"xml(<remap from="a" to="b c"/>)xml", "expected 'to' of <remap> to be a name of ROS, found 'b c'"},
      {R"xml(<test test-name="t" pkg="p" type="t" time-limit="0"/>)xml",
       "expected 'time-limit' of <test> to be a positive number of seconds, found '0'"},
      {R"xml(<test test-name="t" pkg="p" type="t" retry="-1"/>)xml",
       "expected 'retry' of <test> to be a number of repetitions, found '-1'"},
  };
  for (const auto& [elements, expected] : cases) EXPECT_EQ(complaint_about(elements), "a.launch:2: " + expected);
}

TEST_F(LaunchErrors, CheckParameters) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"xml(<param name="a"/>)xml", "expected 'value' or 'textfile' of <param>, found none"},
      {R"xml(<param name="a" value="1" textfile="t"/>)xml", "expected 'value' or 'textfile' of <param>, found both"},
      {R"xml(<param name="a" value="x" type="int"/>)xml", "expected a value of type int in <param>, found 'x'"},
      {R"xml(<param name="a" value="x" type="real"/>)xml",
       "expected 'type' of <param> to be auto, str, string, int, double, bool, boolean or yaml, found 'real'"},
      {R"xml(<param name="a" value="4000000000"/>)xml",
       "expected the parameter '/a' to be an integer of 32 bits, found 4000000000"},
      {R"xml(<param name="a-b" value="1"/>)xml", "expected the name of a parameter in <param>, found 'a-b'"},
      {R"xml(<param name="a" value="~" type="yaml"/>)xml", "expected a value of the parameter '/a', found null"},
      {R"xml(<param name="a" value="[1" type="yaml"/>)xml", "this is not valid YAML: end of sequence flow not found"},
      {R"xml(<rosparam>3</rosparam>)xml", "expected 'param' of <rosparam>, or a map of parameters"},
      {R"xml(<rosparam>{a b: 1}</rosparam>)xml", "expected the name of a parameter in '/', found 'a b'"},
      {R"xml(<rosparam file="f">a: 1</rosparam>)xml", "expected a file or a text of <rosparam>, found both"},
      {R"xml(<rosparam param="x">rad(2*e)</rosparam>)xml", "expected numbers and pi in an angle, found 'rad(2*e)'"},
  };
  for (const auto& [elements, expected] : cases) EXPECT_EQ(complaint_about(elements), "a.launch:2: " + expected);
  EXPECT_EQ(complaint_about("<param name=\"a\" value=\"1\"/>\n<param name=\"a/b\" value=\"2\"/>"),
            "a.launch:3: expected no parameter '/a/b': '/a' has a value, at a.launch:2");
  EXPECT_EQ(complaint_about("<param name=\"a/b\" value=\"1\"/>\n<param name=\"a\" value=\"2\"/>"),
            "a.launch:3: expected no parameter '/a': there is '/a/b' at a.launch:2");
}

TEST_F(LaunchErrors, NameLinesWithinEmbeddedYaml) {
  EXPECT_EQ(complaint_about("<rosparam>\n  a: 1\n  b: 2\n  a: 3\n</rosparam>"),
            "a.launch:5: key 'a' is given twice, first at a.launch:3");
  folder_.write("p.yaml", "a: 1\nb: [");
  EXPECT_EQ(complaint_about(R"xml(<rosparam file="p.yaml"/>)xml"),
            "p.yaml:2: this is not valid YAML: end of sequence flow not found");
}

TEST_F(LaunchErrors, CheckSubstitutions) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"$(arg x)", "there is no argument 'x' here"},
      {"$(arg spede)", "there is no argument 'spede' here, did you mean 'speed'?"},
      {"$(arg open)", "expected a value of the argument 'open', found none"},
      {"$(arg)", "expected $(arg NAME), found '$(arg)'"},
      {"$(env WAITPOINT)", "expected the variable 'WAITPOINT' in the environment, found none"},
      {"$(optenv)", "expected $(optenv NAME DEFAULT), found '$(optenv)'"},
      {"$(find a b)", "expected $(find PACKAGE), found '$(find a b)'"},
      {"$(find no)/x", "there is no package 'no' in share"},
      {"$(anon a/b)", "expected $(anon WORD) with a name, found 'a/b'"},
      {"$(dirname x)", "expected $(dirname), found '$(dirname x)'"},
      {"$(argh x)", "unknown substitution '$(argh x)', did you mean 'arg'?"},
      {"$(command x)", "unknown substitution '$(command x)', expected arg, find, env, optenv, anon, dirname or eval"},
      {"$()", "expected a substitution such as $(arg NAME), found '$()'"},
      {"x$(arg y", "expected a ')' after '$(arg y'"},
      {"$(arg $(arg y))", "expected a ')' after '$(arg '"},
      {"x $(eval 1)", "expected $(eval ...) to be the whole text, found a text around it"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string elements =
        R"xml(<arg name="speed" default="1"/><arg name="open"/><param name="p" value=")xml" + text + R"xml("/>)xml";
    EXPECT_EQ(complaint_about(elements), "a.launch:2: " + expected);
  }
}

TEST_F(LaunchErrors, CheckArgumentsAgainstTheirDeclarations) {
  EXPECT_EQ(complaint_about(R"xml(<arg name="a"/> <arg name="a"/>)xml"),
            "a.launch:2: the argument 'a' is declared twice");
  EXPECT_EQ(complaint_about(R"xml(<arg name="a" value="1" default="2"/>)xml"),
            "a.launch:2: expected 'value' or 'default' of <arg>, found both");
  EXPECT_EQ(complaint_about(R"xml(<arg name="a" value="1"/>)xml", {{"a", "2"}}),
            "a.launch:2: the argument 'a' has a 'value' here, it cannot be given from outside");
  EXPECT_EQ(complaint_about(R"xml(<arg name="speed"/>)xml", {{"sped", "2"}}),
            "s.yaml:7: the file 'a.launch' has no argument 'sped', did you mean 'speed'?");
}

TEST_F(LaunchErrors, RefuseTwoNodesOfOneName) {
  EXPECT_EQ(complaint("<launch>\n<node pkg='p' type='t' name='n' ns='a'/>\n<group ns='a'>\n<node pkg='p' type='u' "
                      "name='n'/></group></launch>"),
            "a.launch:4: there are two nodes called '/a/n', the first at a.launch:2");
}

TEST_F(LaunchErrors, NameTheChainOfIncludes) {
  folder_.write("c.launch", "<launch>\n<nodes/>\n</launch>");
  folder_.write("b.launch", "<launch><include file='c.launch'/></launch>");
  EXPECT_EQ(
      complaint_about("<include file='b.launch'/>"),
      "c.launch:2: unknown element <nodes> in <launch>, did you mean 'node'? (included at b.launch:1) (included at "
      "a.launch:2)");
  folder_.write("c.launch", "<launch>\n<launch>");
  EXPECT_EQ(complaint_about("<include file='c.launch'/>"),
            "c.launch:2: expected XML, found XML_ERROR_MISMATCHED_ELEMENT (included at a.launch:2)");
  EXPECT_NE(complaint_about("<include file='none.launch'/>").find("(included at a.launch:2)"), std::string::npos);
  folder_.write("c.launch", "<launch><arg name='x'/><param name='p' value='$(arg x)'/></launch>");
  EXPECT_EQ(complaint_about("<include file='c.launch'/>"),
            "c.launch:1: expected a value of the argument 'x', found none (included at a.launch:2)");
  EXPECT_EQ(complaint_about("<include file='c.launch'>\n<arg name='z' value='1'/><arg name='x' value='1'/></include>"),
            "a.launch:3: the file 'c.launch' has no argument 'z'");
  EXPECT_EQ(complaint_about("<include file='c.launch'><arg name='x'/></include>"),
            "a.launch:2: expected a 'value' of the argument 'x' that is passed, found none");
}

TEST_F(LaunchErrors, BoundIncludes) {
  EXPECT_EQ(complaint_about("<include file='a.launch'/>"),
            "a.launch: expected a file that does not include itself (included at a.launch:2)");
  // Two includes in each of twenty files: a million.
  for (int i = 0; i < 20; ++i)
    folder_.write("f" + std::to_string(i) + ".launch", "<launch><include file='f" + std::to_string(i + 1) +
                                                           ".launch'/><include file='f" + std::to_string(i + 1) +
                                                           ".launch'/></launch>");
  folder_.write("f20.launch", "<launch/>");
  EXPECT_NE(complaint_about("<include file='f0.launch'/>").find("expected at most 1000 launch files"),
            std::string::npos);
}

TEST_F(LaunchErrors, BoundTexts) {
  std::string elements = "<arg name='a0' value='0123456789abcdef'/>";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "$(arg a" + std::to_string(i - 1) + ")";
    elements.append("<arg name='a").append(std::to_string(i)).append("' value='").append(before + before + "'/>");
  }
  EXPECT_EQ(complaint_about(elements), "a.launch:2: expected a text of at most 1 MiB after substitution");
}

TEST_F(LaunchErrors, BoundElements) {
  std::string many, groups;
  for (int i = 0; i < 1100; ++i) many += "<arg name='a" + std::to_string(i) + "' value='1'/>";
  EXPECT_EQ(complaint_about(many),
            "a.launch:2: expected at most 2000 arguments, remappings, variables and parameters of nodes in a scope");
  for (int i = 0; i < 20'001; ++i) groups += "<group/>";
  EXPECT_EQ(complaint_about(groups), "a.launch:2: expected at most 20000 elements in all files of a launch");
}

TEST_F(LaunchErrors, RefuseFilesOfOtherFormats) {
  EXPECT_EQ(complaint("<robot/>"), "a.launch:1: expected the outermost element to be <launch>");
  EXPECT_EQ(complaint("<launch x='1'/>"),
            "a.launch:1: unknown attribute 'x' of <launch>, expected deprecated, if or unless");
  EXPECT_NE(complaint("").find("a.launch: "), std::string::npos);
  EXPECT_EQ(complaint("no XML"), "a.launch:1: expected XML, found XML_ERROR_PARSING_TEXT");
}

}  // namespace
}  // namespace waitpoint::ros1
