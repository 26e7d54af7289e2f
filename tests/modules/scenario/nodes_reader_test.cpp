// SPDX-License-Identifier: BSD-3-Clause
// The nodes of ROS that a scenario's robots have: the keys `ros`, `launch` and `nodes`.
#include <gtest/gtest.h>

#include "core/confinement.hpp"
#include "modules/ros1/launch.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

class NodesReader : public ::testing::Test {
 protected:
  /// The valid scenario, whose robots have these lines, too.
  Scenario read(const std::string& of_one, const std::string& of_two = "", const std::string& of_all = "") const {
    std::string text = changed("    goals:\n", of_one + "    goals:\n");
    const std::string_view start = "    start: {x_m: 3, y_m: 2}\n";
    text.insert(text.find(start), of_two);
    return read_scenario(folder_.write("s.yaml", text + of_all));
  }
  /// Line numbers are those of the valid scenario, in which the lines of robot one begin at 34.
  std::string complaint(const std::string& of_one, const std::string& of_two = "") const {
    std::string message = message_of<BadInput>([&] { read(of_one, of_two); });
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = message.find(folder); at != message.npos; at = message.find(folder))
      message.erase(at, folder.size());
    return message;
  }
  static const ros1::Launch& launch_of(const RobotScenario& robot) { return *robot.nodes->launch; }

  TemporaryFolder folder_;
};

TEST_F(NodesReader, RobotsWithoutTheKeysHaveNoNodes) {
  const Scenario scenario = read("");
  EXPECT_FALSE(scenario.robots[0].nodes);
  EXPECT_FALSE(scenario.robots[0].goals_are_for_nodes());
  EXPECT_FALSE(scenario.ros.publishes_clock);
  EXPECT_EQ(scenario.ros.master, RosScenario::Master::inside);
}

TEST_F(NodesReader, ReadsProgramsNamesAndParameters) {
  const Scenario scenario = read(R"yaml(    nodes:
      - name: driver
        command: [nodes/driver, --fast]
        arguments: [_rate:=5]
        params: {speed_m_s: 0.5, limits: {low: -1}, frame: base_link, on: yes}
        remap: {cmd_vel: base/cmd_vel, /odom: odom2}
        environment: {LANG: C}
        after: [rsp.started, "topic:map", "service:/static_map", "tcp:11311"]
        required: true
        output: screen
        clock: "interval:10..50"
        clear_params: true
      - {name: rsp, package: robot_state_publisher, type: publisher, namespace: sub}
      - {name: off, command: [true], enabled: false}
)yaml");
  ASSERT_TRUE(scenario.robots[0].nodes);
  const ros1::Launch& launch = launch_of(scenario.robots[0]);
  ASSERT_EQ(launch.nodes.size(), 2U);
  const ros1::Node& driver = launch.nodes[0];
  EXPECT_EQ(driver.global_name(), "/driver");
  EXPECT_EQ(driver.command, (std::vector<std::string>{(folder_.path() / "nodes/driver").string(), "--fast"}));
  EXPECT_EQ(driver.arguments, (std::vector<std::string>{"_rate:=5"}));
  EXPECT_EQ(driver.remappings[0].to, "base/cmd_vel");
  EXPECT_EQ(driver.remappings[1].from, "/odom");
  EXPECT_EQ(driver.environment[0].value, "C");
  EXPECT_EQ(driver.after[0].of, "/sub/rsp");
  EXPECT_EQ(driver.after[1].of, "/map");
  EXPECT_EQ(driver.after[2].kind, StartCondition::Kind::service);
  EXPECT_EQ(driver.after[3].port, 11311);
  EXPECT_TRUE(driver.required);
  EXPECT_EQ(driver.output, ros1::Node::Output::screen);
  EXPECT_EQ(driver.clock, "interval:10..50");
  EXPECT_EQ(launch.cleared, (std::vector<std::string>{"/driver"}));
  EXPECT_EQ(launch.nodes[1].package, "robot_state_publisher");
  EXPECT_EQ(launch.nodes[1].global_name(), "/sub/rsp");
  std::string parameters;
  for (const auto& [name, parameter] : launch.parameters) parameters += name + "=" + parameter.value.dump() + " ";
  EXPECT_EQ(parameters, R"(/driver/frame="base_link" /driver/limits/low=-1 /driver/on=true /driver/speed_m_s=0.5 )");
}

TEST_F(NodesReader, LaunchFilePrecedesNodes) {
  folder_.write("r/a.launch", R"xml(<launch><arg name="use_map"/><arg name="n" default="1"/>
    <node pkg="p" type="t" name="map" if="$(arg use_map)"> <param name="n" value="$(arg n)"/> <param name="m" value="2"/> </node>
    </launch>)xml");
  const Scenario scenario = read(R"yaml(    launch: {file: r/a.launch, args: {use_map: true}}
    nodes:
      - {name: user, command: [user], after: [map], params: {x: 1}}
)yaml");
  const ros1::Launch& launch = launch_of(scenario.robots[0]);
  ASSERT_EQ(launch.nodes.size(), 2U);
  EXPECT_EQ(launch.nodes[0].global_name(), "/map");
  EXPECT_EQ(launch.nodes[1].command, (std::vector<std::string>{"user"}));
  EXPECT_EQ(launch.parameters.at("/map/n").value, 1);
  EXPECT_EQ(launch.parameters.at("/user/x").value, 1);
  const Scenario found = read("    launch: {file: $(optenv WAITPOINT_NONE r)/a.launch, args: {use_map: false}}\n");
  EXPECT_TRUE(launch_of(found.robots[0]).nodes.empty());
}

TEST_F(NodesReader, LaunchFilesArePartOfTheFingerprint) {
  const auto fingerprint = [this](const std::string& text) {
    folder_.write("a.launch", text);
    return read("    launch: a.launch\n").fingerprint;
  };
  EXPECT_EQ(fingerprint("<launch/>"), fingerprint("<launch/>"));
  EXPECT_NE(fingerprint("<launch/>"), fingerprint("<launch></launch>"));
}

TEST_F(NodesReader, SeveralRobotsHaveSeparateNamespaces) {
  const std::string node = "    nodes: [{name: a, command: [x]}]\n";
  const Scenario scenario = read(node, node + "    ros: {tf_prefix: \"\"}\n", "ros: {clock: true, master: outside}\n");
  EXPECT_EQ(scenario.robots[0].nodes->ns, "/one");
  EXPECT_EQ(scenario.robots[0].nodes->tf_prefix, "one");
  EXPECT_EQ(launch_of(scenario.robots[0]).nodes[0].global_name(), "/one/a");
  EXPECT_EQ(scenario.robots[1].nodes->ns, "/two");
  EXPECT_EQ(scenario.robots[1].nodes->tf_prefix, "");
  EXPECT_TRUE(scenario.ros.publishes_clock);
  EXPECT_EQ(scenario.ros.master, RosScenario::Master::outside);
}

TEST_F(NodesReader, OneRobotHasTheGivenNamespaceOrNone) {
  EXPECT_EQ(read("    ros: {}\n").robots[0].nodes->ns, "/");
  EXPECT_EQ(read("    ros: {namespace: \"\"}\n").robots[0].nodes->ns, "/");
  const Scenario scenario = read("    ros: {namespace: a/b}\n    nodes: [{name: n, command: [x]}]\n");
  EXPECT_EQ(scenario.robots[0].nodes->ns, "/a/b");
  EXPECT_EQ(scenario.robots[0].nodes->tf_prefix, "");
  EXPECT_EQ(launch_of(scenario.robots[0]).nodes[0].global_name(), "/a/b/n");
}

TEST_F(NodesReader, RobotsOverrideNodesOfTheirTypeByName) {
  const std::string type =
      "    executive: {patience_s: 3}\n    nodes:\n      - {name: a, command: [x], params: {p: 1, q: 2}}\n";
  const Scenario scenario = read_scenario(folder_.write("s.yaml", changed("    executive: {patience_s: 3}\n", type)),
                                          {"robots.two.nodes=[{name: a, params: {q: 3}}]"});
  EXPECT_EQ(launch_of(scenario.robots[0]).parameters.at("/one/a/q").value, 2);
  EXPECT_EQ(launch_of(scenario.robots[1]).parameters.at("/two/a/q").value, 3);
  EXPECT_EQ(launch_of(scenario.robots[1]).parameters.at("/two/a/p").value, 1);
}

TEST_F(NodesReader, GoalsGoToNodesOfARobotWithoutModules) {
  const std::string nodes = "    nodes: [{name: a, command: [x]}]\n";
  EXPECT_FALSE(read(nodes).robots[0].goals_are_for_nodes());
  EXPECT_TRUE(read(nodes + "    modules: [{name: rflex, enabled: false}, {name: front, enabled: false}]\n")
                  .robots[0]
                  .goals_are_for_nodes());
}

TEST_F(NodesReader, ReportsErrorsOfNodesAtTheirLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{name: a}", "expected a command, or a package and a type, in a node, found none"},
      {"{name: a, command: [x], package: p}", "expected a command, or a package and a type, in a node, found both"},
      {"{name: a, package: p}", "expected key 'type' in a node"},
      {"{name: a/b, command: [x]}", "expected the name of a node to be of letters, digits and '_', found 'a/b'"},
      {"{name: a, command: [x], param: {}}", "unknown key 'param' in a node, did you mean 'params'?"},
      {"{name: a, command: [x], params: {a-b: 1}}",
       "expected the name of a node's own parameter in params, found 'a-b'"},
      {"{name: a, command: [x], params: [1]}", "expected params to be a map of parameters, found a list"},
      {"{name: a, command: [x], params: {p: 3000000000}}",
       "expected the parameter '/a/p' to be an integer of 32 bits, found 3000000000"},
      {"{name: a, command: [x], remap: {a: b c}}",
       "expected a name in remap to be a name of ROS: letters, digits, '_' and '/', found 'b c'"},
      {"{name: a, command: [x], after: [\"topic:\"]}",
       "expected NODE, NODE.started, tcp:PORT, topic:NAME, service:NAME or a path with a '/' in after, found 'topic:'"},
      {"{name: a, command: [x], after: [b]}", "after: the robot has no node 'b'"},
      {"{name: a, command: [x], after: [a]}", "'a' can never start: the conditions in after form a cycle"},
      {"{name: a, command: [x], output: file}", "expected output to be log or screen, found 'file'"},
      {"{name: a, command: [x], namespace: 1}",
       "expected namespace to be a name of ROS: letters, digits, '_' and '/', found '1'"},
  };
  for (const auto& [node, expected] : cases)
    EXPECT_EQ(complaint("    nodes:\n      - " + node + "\n"), "s.yaml:35: " + expected);
  EXPECT_EQ(complaint("    nodes:\n      - {name: a, command: [x]}\n      - {name: a, command: [y]}\n"),
            "s.yaml:36: there are two nodes called '/a', the first at s.yaml:35");
}

TEST_F(NodesReader, ReportsErrorsOfLaunchFilesAtTheirLine) {
  EXPECT_EQ(complaint("    launch: none.launch\n"),
            "s.yaml:34: expected a launch file, found 'none.launch', which is no file");
  EXPECT_EQ(complaint("    launch: $(find waitpoint_none)/a.launch\n").substr(0, 54),
            "s.yaml:34: there is no package 'waitpoint_none' in /us");
  folder_.write("a.launch", "<launch>\n<nodes/></launch>");
  EXPECT_EQ(complaint("    launch: a.launch\n"),
            "a.launch:2: unknown element <nodes> in <launch>, did you mean 'node'?");
  folder_.write("a.launch", "<launch><arg name='map'/></launch>");
  EXPECT_EQ(complaint("    launch: {file: a.launch, args: {mpa: 1}}\n"),
            "s.yaml:34: the file 'a.launch' has no argument 'mpa', did you mean 'map'?");
  folder_.write("a.launch", "<launch><node pkg='p' type='t' name='a'/></launch>");
  EXPECT_EQ(complaint("    launch: a.launch\n    nodes:\n      - {name: a, command: [x]}\n"),
            "s.yaml:36: there are two nodes called '/a', the first at a.launch:1");
}

TEST_F(NodesReader, RefusesNodesInConfinedRuns) {
  const Confinement confinement(std::vector{folder_.path()});
  EXPECT_EQ(complaint("    nodes: [{name: a, command: [x]}]\n"),
            "s.yaml:34: nodes of ROS are not started with --confined");
}

TEST_F(NodesReader, RefusesRobotsOfOneRosName) {
  const std::string node = "[{name: a, command: [x], namespace: /all}]\n";
  EXPECT_EQ(complaint("    nodes: " + node, "    nodes: " + node),
            "s.yaml:40: there are two nodes called '/all/a', the first at s.yaml:34");
  EXPECT_EQ(complaint("    ros: {namespace: x}\n", "    ros: {namespace: /x}\n"),
            "s.yaml:38: there are two robots with the namespace '/x' of ROS, the first at s.yaml:31");
  EXPECT_EQ(complaint("    ros: {namespace: a-b}\n"),
            "s.yaml:34: expected namespace to be a name of ROS: letters, digits, '_' and '/', found 'a-b'");
}

}  // namespace
}  // namespace waitpoint::scenario
