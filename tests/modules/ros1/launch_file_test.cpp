// SPDX-License-Identifier: BSD-3-Clause
// What launch files say, by the rules of roslaunch.
#include <gtest/gtest.h>

#include "tests/modules/ros1/launch_text.hpp"

namespace waitpoint::ros1 {
namespace {

class LaunchFile : public LaunchTexts {};

TEST_F(LaunchFile, ReadsTheAttributesOfANode) {
  const Launch launch = read(R"xml(<?xml version="1.0"?>
<launch>
  <!-- a comment -->
  <node pkg="nav" type="amcl" name="amcl" ns="loc" args="--fast 'two words' _x:=1" output="screen" required="true"
        respawn="FALSE" cwd="node"/>
  <node pkg="nav" type="map.py" name="map"/>
</launch>)xml",
                             {}, "/rackham");
  ASSERT_EQ(launch.nodes.size(), 2U);
  const Node& amcl = launch.nodes[0];
  EXPECT_EQ(amcl.global_name(), "/rackham/loc/amcl");
  EXPECT_EQ(amcl.package + "/" + amcl.type, "nav/amcl");
  EXPECT_EQ(amcl.arguments, (std::vector<std::string>{"--fast", "two words", "_x:=1"}));
  EXPECT_TRUE(amcl.required);
  EXPECT_EQ(amcl.output, Node::Output::screen);
  EXPECT_EQ(amcl.folder, Node::Folder::of_program);
  EXPECT_EQ(amcl.written.line, 4);
  const Node& map = launch.nodes[1];
  EXPECT_EQ(map.ns, "/rackham");
  EXPECT_FALSE(map.required);
  EXPECT_EQ(map.output, Node::Output::log);
  EXPECT_TRUE(map.arguments.empty());
}

TEST_F(LaunchFile, GivesParametersTheirTypes) {
  EXPECT_EQ(text_of(read_elements(R"xml(
    <param name="a" value="3"/> <param name="b" value="3.5"/> <param name="c" value="True"/> <param name="d" value="x y"/>
    <param name="e" value="1e3"/> <param name="f" value="3" type="str"/> <param name="g" value="3" type="double"/>
    <param name="h" value="1" type="bool"/> <param name="i" value="[1, {j: 2.5}]" type="yaml"/>
    <param name="k" value="-7" type="int"/> <param name="l" value=""/>)xml")
                        .parameters),
            R"xml(/a=3 /b=3.5 /c=true /d="x y" /e="1e3" /f="3" /g=3.0 /h=true /i=[1,{"j":2.5}] /k=-7 /l="")xml");
}

TEST_F(LaunchFile, PutsParametersIntoNamespacesAndNodes) {
  EXPECT_EQ(text_of(read_elements(R"xml(
    <param name="a" value="1"/> <param name="/b" value="2"/>
    <group ns="g">
      <param name="c" value="3"/>
      <param name="~all" value="4"/>
      <node pkg="p" type="t" name="n"> <param name="d" value="5"/> <param name="~e" value="6"/> </node>
      <node pkg="p" type="t" name="m" ns="/deep/down"> <rosparam>{f: 7, g: {h: 8}}</rosparam> </node>
    </group>
    <node pkg="p" type="t" name="o"/>)xml")
                        .parameters),
            "/a=1 /b=2 /deep/down/m/all=4 /deep/down/m/f=7 /deep/down/m/g/h=8 /g/c=3 /g/n/all=4 /g/n/d=5 /g/n/e=6");
}

TEST_F(LaunchFile, LaterParametersReplaceEarlierOnes) {
  EXPECT_EQ(text_of(read_elements(R"xml(<param name="a" value="1"/> <rosparam>{a: 2, b: 3}</rosparam>
                                     <param name="b" value="4"/>)xml")
                        .parameters),
            "/a=2 /b=4");
}

TEST_F(LaunchFile, RosparamReadsYamlFromTextAndFiles) {
  folder_.write("p.yaml", "speed: 0.5\nlimits: {low: -1, high: 1}\nname: yes\n");
  folder_.write("list.yaml", "[1, 2]");
  EXPECT_EQ(text_of(read_elements(R"xml(<arg name="x" default="9"/>
    <rosparam file="p.yaml" command="load" ns="base"/>
    <rosparam file="$(dirname)/list.yaml" param="numbers"/>
    <rosparam param="text" subst_value="true">[$(arg x)]</rosparam>
    <rosparam>
      a:
        b: 1
      c: rad(pi/2)
    </rosparam>
    <rosparam/>)xml")
                        .parameters),
            "/a/b=1 /base/limits/high=1 /base/limits/low=-1 /base/name=true /base/speed=0.5 /c=1.5707963267948966 "
            "/numbers=[1,2] /text=[9]");
}

TEST_F(LaunchFile, ReadsAParameterFromATextFile) {
  folder_.write("r.urdf", "<robot/>\n");
  EXPECT_EQ(text_of(read_elements(R"xml(<param name="robot_description" textfile="r.urdf"/>)xml").parameters),
            R"xml(/robot_description="<robot/>\n")xml");
}

TEST_F(LaunchFile, RemappingsAndVariablesEndWithTheirScope) {
  const Launch launch = read_elements(R"xml(
    <remap from="scan" to="base_scan"/> <env name="A" value="1"/>
    <group>
      <remap from="odom" to="/wheels//odom/"/> <env name="B" value=""/>
      <node pkg="p" type="t" name="a"> <remap from="scan" to="other"/> <env name="A" value="2"/> </node>
    </group>
    <node pkg="p" type="t" name="b"/> <remap from="late" to="x"/>)xml");
  EXPECT_EQ(text_of(launch.nodes[0].remappings), "odom:/wheels/odom scan:other");
  EXPECT_EQ(text_of(launch.nodes[0].environment), "B= A=2");
  EXPECT_EQ(text_of(launch.nodes[1].remappings), "scan:base_scan");
  EXPECT_EQ(text_of(launch.nodes[1].environment), "A=1");
}

TEST_F(LaunchFile, ConditionsSelectElements) {
  EXPECT_EQ(text_of(read_elements(R"xml(<arg name="sim" default="true"/> <arg name="kind" default="fast"/>
    <param name="a" value="1" if="$(arg sim)"/> <param name="b" value="1" unless="$(arg sim)"/>
    <group if="0"> <param name="c" value="1"/> </group> <group unless="False"> <param name="d" value="1"/> </group>
    <param name="e" value="1" if="$(eval kind == 'fast' and sim)"/>
    <include file="none.launch" unless="1"/>)xml")
                        .parameters),
            "/a=1 /d=1 /e=1");
}

TEST_F(LaunchFile, ArgumentsAreGivenOrDefault) {
  const std::string text = R"xml(<arg name="a" default="1"/> <arg name="b" default="$(arg a)$(arg a)"/>
    <arg name="c" value="fixed"/> <param name="p" value="$(arg a) $(arg b) $(arg c)"/>)xml";
  EXPECT_EQ(text_of(read_elements(text).parameters), R"xml(/p="1 11 fixed")xml");
  EXPECT_EQ(text_of(read_elements(text, {{"a", "x"}}).parameters), R"xml(/p="x xx fixed")xml");
}

TEST_F(LaunchFile, IncludedFilesSeeOnlyPassedArguments) {
  folder_.write("inner/b.launch", R"xml(<launch> <arg name="x"/> <arg name="y" default="of b"/>
    <param name="p" value="$(arg x), $(arg y)"/> <param name="at" value="$(dirname)"/>
    <include file="c.launch" if="false"/> <node pkg="p" type="t" name="n"/> </launch>)xml");
  const Launch launch = read_elements(R"xml(<arg name="y" default="of a"/> <remap from="u" to="v"/>
    <include file="inner/b.launch" ns="sub"> <arg name="x" value="1"/> <env name="E" value="e"/> </include>
    <group ns="all"> <include file="$(dirname)/inner/b.launch" pass_all_args="true"> <arg name="x" value="2"/>
    </include> </group>)xml");
  EXPECT_EQ(text_of(launch.parameters), R"xml(/all/at=")xml" + (folder_.path() / "inner").string() +
                                            R"xml(" /all/p="2, of a" /sub/at=")xml" +
                                            (folder_.path() / "inner").string() + R"xml(" /sub/p="1, of b")xml");
  ASSERT_EQ(launch.nodes.size(), 2U);
  EXPECT_EQ(launch.nodes[0].global_name(), "/sub/n");
  EXPECT_EQ(text_of(launch.nodes[0].remappings), "u:v");
  EXPECT_EQ(text_of(launch.nodes[0].environment), "E=e");
  EXPECT_EQ(launch.nodes[1].global_name(), "/all/n");
  EXPECT_TRUE(launch.nodes[1].environment.empty());
}

TEST_F(LaunchFile, SubstitutesNamesAndPaths) {
  variables_ = {{"ROBOT", "rackham"}};
  folder_.write("share/maps/package.xml", "<package><name>maps</name></package>");
  const Launch launch = read_elements(R"xml(<param name="a" value="$(env ROBOT) $(optenv ROBOT x)"/>
    <param name="b" value="$(optenv NONE two words)|$(optenv NONE)"/>
    <param name="c" value="$(find maps)/office.yaml costs 5$ $x"/>
    <node pkg="p" type="t" name="$(anon talker)"/> <param name="d" value="$(anon talker)"/>
    <group> <node pkg="p" type="t" name="$(anon other)"/> </group>)xml");
  EXPECT_EQ(text_of(launch.parameters), R"xml(/a="rackham rackham" /b="two words|" /c=")xml" +
                                            (folder_.path() / "share/maps").string() +
                                            R"xml(/office.yaml costs 5$ $x" /d="talker_1")xml");
  EXPECT_EQ(launch.nodes[0].name, "talker_1");
  EXPECT_EQ(launch.nodes[1].name, "other_2");
}

TEST_F(LaunchFile, KeepsTestsSeparate) {
  const Launch launch = read_elements(R"xml(
    <test test-name="drives" pkg="p" type="t.test" time-limit="90.5" retry="2" args="-v"> <param name="x" value="1"/> </test>
    <test test-name="stands" name="checker" pkg="p" type="t"/>)xml");
  EXPECT_TRUE(launch.nodes.empty());
  ASSERT_EQ(launch.tests.size(), 2U);
  EXPECT_EQ(launch.tests[0].name, "drives");
  EXPECT_EQ(launch.tests[0].node.name, "drives");
  EXPECT_EQ(launch.tests[0].time_limit_s, 90.5);
  EXPECT_EQ(launch.tests[0].retries, 2);
  EXPECT_EQ(launch.tests[1].node.name, "checker");
  EXPECT_EQ(launch.tests[1].time_limit_s, 60);
  EXPECT_EQ(text_of(launch.parameters), "/drives/x=1");
}

TEST_F(LaunchFile, ClearsNamespacesOnRequest) {
  EXPECT_EQ(read_elements(R"xml(<group ns="g" clear_params="true"> <node pkg="p" type="t" name="n" clear_params="true"/>
                             </group>)xml")
                .cleared,
            (std::vector<std::string>{"/g", "/g/n"}));
}

TEST_F(LaunchFile, FingerprintCoversAllFiles) {
  const std::string text = R"xml(<launch> <include file="b.launch"/> </launch>)xml";
  folder_.write("b.launch", "<launch/>");
  const std::uint64_t first = read(text).fingerprint;
  EXPECT_NE(first, 0U);
  EXPECT_EQ(read(text).fingerprint, first);
  folder_.write("b.launch", "<launch></launch>");
  EXPECT_NE(read(text).fingerprint, first);
}

TEST_F(LaunchFile, WarnsOfADeprecatedFile) {
  const Launch launch = read(R"xml(<launch deprecated="use b.launch"/>)xml");
  ASSERT_EQ(launch.warnings.size(), 1U);
  EXPECT_NE(launch.warnings[0].find("a.launch:1: the launch file is deprecated: use b.launch"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::ros1
