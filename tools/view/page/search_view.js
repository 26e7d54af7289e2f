// SPDX-License-Identifier: BSD-3-Clause
// A search for failing schedules that goes on in the program at the other end of the connection. Once there is a
// finding, the page is loaded anew: it is that of the finding then.

class SearchView {
  constructor(search) {
    setText(byId("scenario"), search.title);
    setText(byId("facts"), `seed ${search.seed} · exploring`);
    document.title = `${search.title} – waitpoint`;
    this.table = new TextTable("Search", ["Number", "Value"]);
    this.words = element("p", {id: "search-words", role: "status"}, "The search begins …");
    const note = element("p", {class: "note"}, "The finding appears here by itself.");
    byId("main").replaceChildren(element("section", {id: "search"}, this.table.table, this.words, note));
    for (const id of ["theme", "help"]) byId(id).hidden = true;
    this.connection = new Connection(
      liveAddress(),
      (news) => this.hear(news),
      () => this.showConnection()
    );
    this.connection.connect();
  }

  hear(news) {
    if (news.kind === "page") return location.reload();
    if (news.schedules !== undefined)
      this.table.set([
        ["Schedules", countText(news.schedules)],
        ["Distinct", countText(news.distinct)],
        ["Failed", countText(news.failures)],
        ["A second", rounded(news.schedules / Math.max(news.seconds, 0.001))]
      ]);
    setText(this.words, news.words || "Searching …");
  }

  showConnection() {
    const open = this.connection.state === "open";
    setText(byId("connection"), open ? "connected" : "connection lost, trying again …");
    byId("connection").className = open ? "good" : "bad";
  }
}
