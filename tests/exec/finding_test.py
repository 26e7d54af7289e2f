# SPDX-License-Identifier: BSD-3-Clause
"""A finding of `waitpoint explore` as a page, as a file, and served: finding_test.py BUILD."""

import base64
import gzip
import http.client
import json
import re
import signal
import subprocess
import unittest
from urllib.parse import urlsplit

from exec_case import ExecCase, WAITPOINT, explore

PATIENCE_S = 120


def waitpoint(*words):
    return subprocess.run([str(word) for word in (WAITPOINT, *words)], stdin=subprocess.DEVNULL, capture_output=True,
                          text=True, timeout=PATIENCE_S)


def data_of(page):
    """What a page shows."""
    return json.loads(gzip.decompress(base64.b64decode(re.search(r'<script id="run"[^>]*>([^<]*)<', page)[1])))


def event(finding, schedule, pair):
    """An event of the pair in a schedule: its task, operation and object, and its number."""
    events = (finding, *finding["others"])[schedule]["events"]
    number = events["marked"][pair]
    at = number - events["first"]
    kind, counted, label, _ = events["objects"][events["x"][at]]
    task = events["tasks"][events["k"][at]]
    return f"{task[1]}#{task[0]}", finding["header"]["operations"][events["o"][at]], f'{kind} #{counted} "{label}"', number


class Served:
    """A command that serves a page, until the end of the block."""

    def __init__(self, *words):
        self.process = subprocess.Popen([str(word) for word in (WAITPOINT, *words)], stdin=subprocess.DEVNULL,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.url = re.search(r"http://\S+", self.process.stderr.readline())[0]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.output, self.errors = self.process.communicate(timeout=PATIENCE_S)
        self.status = self.process.returncode

    def get(self, query=None, **headers):
        address = urlsplit(self.url)
        connection = http.client.HTTPConnection(address.netloc, timeout=PATIENCE_S)
        connection.request("GET", f"/?{address.query if query is None else query}", headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()

    def wait_for(self, words):
        for line in self.process.stderr:
            if words in line:
                return
        raise AssertionError(f"it ended without '{words}'")


class Finding(ExecCase):
    def setUp(self):
        self.program = self.compile("lost_update.c", "-g")
        self.page, self.file = self.folder / "page.html", self.folder / "finding.json"
        for made in (self.page, self.file):
            made.unlink(missing_ok=True)

    def test_page_and_file_have_the_contents_of_the_report(self):
        done = explore("--page", self.page, "--finding", self.file, "--", self.program)
        self.assertEqual(done.returncode, 1, done.stderr)
        finding = json.loads(self.file.read_text())
        self.assertEqual(data_of(self.page.read_text()), finding)
        self.assertNotRegex(self.page.read_text(), r'(src|href)="http')
        told = finding["finding"]
        self.assertEqual(told["report"], done.stdout.split("\n", 1)[1], "all but the line about the search")
        self.assertEqual(told["failure"], "exit status 1\n  an update was lost")
        self.assertIn(f"replay: {told['replay']}\n", done.stdout)
        self.assertIn(told["steps"], done.stdout)
        self.assertIn(f"could still have passed: {told['choice']}\n", done.stdout)
        # The same two events, in the order of each schedule, with the stacks of the report.
        for schedule, pair, which in ((0, 0, "failing"), (1, 1, "passing")):
            task, operation, thing, _ = event(finding, schedule, pair)
            words = re.search(rf"first in \w+ {which} run: +(at .*)\n      at (.*)", done.stdout)
            self.assertIn(f"{task} of lost_update, about to {operation} {thing}", words[1])
            mark = next(mark for mark in finding["marks"] if (mark["line"], mark["pair"]) == (schedule, pair))
            self.assertEqual(mark["words"], words[1])
            frame = mark["frames"][0]
            self.assertEqual(f"{frame['function']} at {frame['file']}:{frame['line']}", words[2])
        numbers = [[event(finding, schedule, pair)[3] for pair in (0, 1)] for schedule in (0, 1)]
        self.assertLess(numbers[0][0], numbers[0][1])
        self.assertGreater(numbers[1][0], numbers[1][1])
        self.assertEqual([row for row in finding["events"]["tasks"]], [[0, "main", "lost_update"], *(
            [number, f"thread {number}", "lost_update"] for number in (1, 2))])

    def test_they_change_neither_report_nor_replay(self):
        plain = explore("--", self.program)
        shown = explore("--page", self.page, "--", self.program)
        self.assertEqual(shown.stdout.splitlines()[1:], plain.stdout.splitlines()[1:])

    def test_beside_a_default_order_that_fails_is_a_run_that_passes(self):
        program = self.folder / "late"
        source = self.folder / "late.c"
        source.write_text("""
            #include <pthread.h>
            static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
            static int order, first;
            static void* come(void* number) {
              pthread_mutex_lock(&mutex);
              if (order++ == 0) first = *(int*)number;
              pthread_mutex_unlock(&mutex);
              return 0;
            }
            int main(void) {
              int numbers[] = {1, 2};
              pthread_t threads[2];
              for (int i = 0; i < 2; ++i) pthread_create(&threads[i], 0, come, &numbers[i]);
              for (int i = 0; i < 2; ++i) pthread_join(threads[i], 0);
              return first == 1;
            }""")
        subprocess.run(["gcc", "-g", "-pthread", source, "-o", program], check=True)
        done = explore("--finding", self.file, "--", program)
        self.assertTrue(done.stdout.startswith("the default order failed"), done.stdout)
        self.assertEqual(done.stdout, explore("--", program).stdout)
        finding = json.loads(self.file.read_text())
        for schedule, tasks in ((0, ["thread 1#1", "thread 2#2"]), (1, ["thread 2#2", "thread 1#1"])):
            pair = sorted((event(finding, schedule, pair) for pair in (0, 1)), key=lambda one: one[3])
            self.assertEqual([(task, operation) for task, operation, *_ in pair], [(task, "lock") for task in tasks])

    def test_without_a_failure_nothing_is_written_and_a_line_says_so(self):
        done = explore("--page", self.page, "--finding", self.file, "--iterations", "20", "--", self.program, "locked")
        self.assertEqual(done.returncode, 0, done.stderr)
        for option, file in (("--page", self.page), ("--finding", self.file)):
            self.assertIn(f"waitpoint: {option}: no schedule failed: {file} is not written\n", done.stderr)
            self.assertFalse(file.exists())

    def test_refused_options(self):
        for words, expected in ((("--page", self.folder / "none/page.html"), "none/page.html"),
                                (("--page", self.page, "--finding", self.page), "--finding"),
                                (("--serve", "127.0.0.1:http"), "waitpoint: --serve: expected an address and a port"),
                                (("--page", self.page, "--replay", "wx1.0.836841f2.=2-0"), "--replay: cannot be used together with --page")):
            done = explore(*words, "--", self.program)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(expected, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertFalse(self.page.exists())

    def test_view_refuses_other_files_than_findings(self):
        explore("--finding", self.file, "--", self.program)
        text = self.file.read_text()
        broken = self.folder / "broken.json"
        for content, expected in ((text[:len(text) // 2], "found no whole JSON"), ("{}", "found other JSON"),
                                  (text.replace('"format":1', '"format":9'), "format 1, found 9"),
                                  (text.replace('"events":{', '"others_events":{'), "found one without events")):
            broken.write_text(content)
            done = waitpoint("view", broken, "--page", self.page)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(str(broken), done.stderr)
            self.assertIn(expected, done.stderr)
            self.assertFalse(self.page.exists())
        done = waitpoint("view", self.folder / "nowhere.json")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"nowhere\.json: cannot be read: No such file")

    def test_view_makes_the_page_of_a_file_and_serves_it(self):
        explore("--finding", self.file, "--", self.program)
        finding = json.loads(self.file.read_text())
        done = waitpoint("view", self.file, "--page", self.page)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(data_of(self.page.read_text()), finding)
        with Served("view", self.file) as served:
            status, text = served.get()
            self.assertEqual((status, data_of(text)), (200, finding))
            self.assertEqual(served.get("token=0")[0], 403)
            self.assertEqual(served.get(Host="elsewhere.example")[0], 403)
        self.assertEqual(served.status, 0)

    def test_a_served_search_shows_how_far_it_is_and_then_its_finding(self):
        with Served("explore", "--serve", "--", self.program) as served:
            served.wait_for("the search is over")
            status, text = served.get()
            finding = data_of(text)
            self.assertEqual(status, 200)
            self.assertEqual(finding["finding"]["failure"], "exit status 1\n  an update was lost")
        self.assertEqual(served.status, 1)
        self.assertIn(finding["finding"]["report"], served.output)

    def test_a_search_without_a_failure_says_so(self):
        with Served("explore", "--iterations", "20", "--serve", "--", self.program, "locked") as served:
            served.wait_for("the search is over")
            self.assertEqual(data_of(served.get()[1])["search"]["title"], f"{self.program} locked")
        self.assertEqual(served.status, 0)

    def test_a_refused_search_ends_its_server(self):
        done = explore("--serve", "--", self.folder / "nowhere")
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main()
