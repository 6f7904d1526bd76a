"""The HTML of a report's Markdown: figures with their captions, headings to link to, tables that scroll."""

from __future__ import annotations

import json
import re

import pytest

from reports.pages.body import body_of
from reports.pages.markdown import Figures
from reports.pages.numbers import unbroken
from reports.pages.pictures import Picture

SVG = b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 60 20"><path d="M0 0 L60 20" stroke="#000"/></svg>'


def html(*captions: str, before: str = "") -> str:
    figures = Figures("sched-sim report late")
    texts = [figures.figure(f"{number}.svg", "it is late", text, ["a.csv"]) for number, text in enumerate(captions)]
    body = body_of(
        before + "\n\n".join(texts), {f"{number}.svg": Picture(SVG, None) for number in range(len(captions))}
    )
    return body.lead + body.rest


@pytest.mark.parametrize(
    ("caption", "stressed"),
    [("It is late.", 0), ("*Late* is late.", 1), ("Late is *late*.", 1), ("*It* is **very** *late*.", 2)],
)
def test_a_caption_may_stress_words_and_its_links_stand_behind_it(caption: str, stressed: int) -> None:
    text = html(caption, "Another *one*.")
    assert text.count("<figure") == text.count("<figcaption>") == text.count("</figcaption>") == 2
    assert text.count("<em>") == text.count("</em>") == stressed + 1
    for file in ("0.svg", "1.svg", "a.csv"):
        assert f'<a href="{file}">' in text
    assert text.count('<span class="files"><a href="a.csv">') == 2


def test_a_figure_that_is_named_is_linked_to() -> None:
    assert '<a href="#figure-1">Figure 1</a> shows' in html("It is late.", before="Figure 1 shows it.\n\n")


def test_a_figure_drawn_for_a_phone_too_says_the_same_there_and_tells_its_own_values() -> None:
    told = [{"plots": [{"title": title}]} for title in ("wide", "narrow")]
    picture = Picture(SVG, told[0], Picture(SVG, told[1]))
    markdown = Figures("sched-sim report late").figure("0.svg", "it is late", "It is late.")
    text = body_of(markdown, {"0.svg": picture}).lead
    assert re.findall('class="ss-scroll ([a-z-]+)"', text) == ["ss-wide", "ss-narrow"]
    assert text.count("<title>it is late</title>") == 2
    assert len(set(re.findall('<svg class="(.*?)"', text))) == 2
    (data,) = re.findall('<script type="application/json">(.*?)</script>', text)
    assert json.loads(data) == {**told[0], "narrow": told[1]}


def test_headings_of_one_text_have_ids_of_their_own() -> None:
    body = body_of("# Title\n\nlead\n\n## Who\n\n### Who\n\n## Where & why\n", {})
    assert [heading.id for heading in body.headings] == ["who", "who-", "where-why"]
    assert body.lead.rstrip().endswith("<p>lead</p>")
    assert all(f'id="{heading.id}"' in body.rest for heading in body.headings)


def test_a_table_scrolls_by_keys_and_is_named_after_its_section() -> None:
    table = body_of("## Who\n\n| a | b |\n| --- | --- |\n| 1 | 2 |\n", {}).rest
    assert re.search(r'<div class="table" role="\w+" tabindex="0" aria-label="Table: Who"><table>', table)


@pytest.mark.parametrize(("name", "shown"), [("position", "table"), ("position over distance", "table long-names")])
def test_long_names_of_rows_have_room(name: str, shown: str) -> None:
    text = body_of(f"## Who\n\n| who | a long heading of numbers |\n| --- | --- |\n| *{name}* | 1 |\n", {}).rest
    assert f'<div class="{shown}" ' in text


@pytest.mark.parametrize(("head", "long"), [("share", False), ("within a factor of", True)])
def test_long_heads_of_columns_have_room(head: str, long: bool) -> None:
    text = body_of(f"## Who\n\n| who | {head} |\n| --- | ---: |\n| a | 1 |\n", {}).rest
    assert ('<th class="long" style="text-align:right">' in text) is long


def test_the_answer_is_marked() -> None:
    assert body_of("# T\n\n**Answer.** Half.\n", {}).lead.count('<p class="answer"><strong>Answer.</strong> Half.') == 1


def test_no_line_ends_between_a_number_and_its_unit() -> None:
    text = body_of('It takes 12.5 % of 40 ms <b title="at 50 %">and</b> 10 steps.\n', {}).lead
    assert text == '<p>It takes 12.5~% of 40~ms <b title="at 50 %">and</b> 10 steps.</p>\n'.replace("~", "\xa0")


def test_no_line_ends_in_a_short_equation_and_code_can_be_copied() -> None:
    found = unbroken("n = 5, n ≥ 4, R / 4; speed = 3; <code>n = 5</code>")
    assert found == "n\xa0=\xa05, n\xa0≥\xa04, R\xa0/\xa04; speed = 3; <code>n = 5</code>"


def test_no_line_ends_after_a_hyphen_of_a_command() -> None:
    found = unbroken("<code>sched-sim report --all &lt;in&gt;-b</code> word-by-word <code>P - <b a-b>c</b></code>")
    words = [f'<span class="word">{word}</span>' for word in ("sched-sim", "--all", "&lt;in&gt;-b", "-")]
    assert found == "<code>{} report {} {}</code> word-by-word <code>P {} <b a-b>c</b></code>".format(*words)


def test_no_line_ends_in_a_day_or_between_a_name_and_its_number() -> None:
    found = unbroken("On 2026-11-29, by Eq. (1) and Secs III.")
    assert found == 'On <span class="day">2026-11-29</span>, by Eq.\xa0(1) and Secs III.'


def test_tables_of_one_section_are_told_apart() -> None:
    table = "| a |\n| --- |\n| b |\n"
    body = body_of(f"## One\n\n{table}\n## Two\n\n{table}\ntext\n\n{table}", {})
    assert re.findall('aria-label="(.*?)"', body.rest) == ["Table: One", "Table 1: Two", "Table 2: Two"]
