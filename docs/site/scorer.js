// SPDX-License-Identifier: MIT
// Ranks search results: pages for users come before pages for developers, and parameters of
// functions come last. The other scores are Sphinx's defaults.
var Scorer = {
  score: function (result) {
    const [page, , , description, score] = result;
    if (/function parameter/.test(description || "")) return score - 30;
    if (/^(development|notes)\//.test(page) || page === "reference/changes") return score - 10;
    if (page === "reference/glossary") return score + 4;
    if (/^(tutorials|how-to)\/|^explanation\/(what-bars-mean|overview)/.test(page)) return score + 2;
    return score;
  },
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
