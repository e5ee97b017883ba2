"""House rules of the templates: they read like what they emit, and know no protocol."""

import ast
import re
from pathlib import Path

import pytest
from framegen.site import rendering
from framegen.targets.docs import markdown_pages
from framegen.targets.python import _environment
from framegen.targets.python.library_view import LibraryView
from framegen.targets.templates import environment
from jinja2 import StrictUndefined, UndefinedError, nodes

from tests.factories import BUSSERVO, DEMO, ROOT, compiled_file, library_of
from tests.in_turn import in_turn

CODEGEN = ROOT / "codegen" / "framegen"
TARGET = CODEGEN / "targets" / "python"
COMMON = sorted((ROOT / "runtime" / "framewire").rglob("*.py"))
TEMPLATES = sorted((TARGET / "templates").rglob("*.jinja"))
SOURCES = sorted(path for path in CODEGEN.rglob("*") if path.suffix in (".py", ".jinja"))

# What a template may be made of: text, loops, conditions, and what is put in place.
ALLOWED = (
    *(nodes.Template, nodes.Output, nodes.TemplateData, nodes.For, nodes.If, nodes.Name),
    *(nodes.Getattr, nodes.Const, nodes.List, nodes.Filter, nodes.FilterBlock, nodes.Concat),
    *(nodes.And, nodes.Not, nodes.Add, nodes.Keyword),
)
FILTERS = {"argument", "assigned", "docstring", "imports", "join", "literal", "quoted"}


def named(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def parsed(template: Path) -> nodes.Template:
    return _environment().parse(template.read_text(encoding="utf-8"))


@in_turn("template", lambda: TEMPLATES)
def test_a_template_has_loops_and_conditions_and_nothing_else(template: Path) -> None:
    """No set, no macro, no include, no arithmetic but for a sum, no comparison, no call."""
    found = {type(node) for node in _walk(parsed(template))}
    assert found - set(ALLOWED) == set()
    filters = {node.name for node in parsed(template).find_all(nodes.Filter)}
    assert filters <= FILTERS


def _walk(node: nodes.Node) -> list[nodes.Node]:
    return [node, *(inner for child in node.iter_child_nodes() for inner in _walk(child))]


@in_turn("template", lambda: TEMPLATES)
def test_text_of_the_spec_goes_through_a_filter(template: Path) -> None:
    """Prose is never put in place as it is; names are, and the checks see to names."""
    prose = {"about", "summary", "description", "title", "unit", "vendor_name", "doc", "version"}
    for output in parsed(template).find_all(nodes.Output):
        for node in output.nodes:
            if isinstance(node, nodes.Getattr):
                assert node.attr not in prose, f"{named(template)}:{node.lineno}"


@in_turn("template", lambda: TEMPLATES)
def test_a_template_fails_on_a_name_that_it_is_not_given(template: Path) -> None:
    assert _environment().undefined is StrictUndefined
    name = template.relative_to(TARGET / "templates").as_posix()
    if any(parsed(template).find_all(nodes.Name)):
        with pytest.raises(UndefinedError):
            _environment().get_template(name).render()


@in_turn("template", lambda: TEMPLATES)
def test_a_template_is_tidy(template: Path) -> None:
    text = template.read_text(encoding="utf-8")
    assert text.endswith("\n")
    assert "\t" not in text
    assert not re.search(r"[ \t]\n", text)
    if template.stem.endswith((".py", ".pyi")):
        begun = '"""', "{{ library.doc | docstring", "{{ [\n", "# What the package exports"
        assert text.startswith(begun)


@pytest.mark.parametrize("spec", [BUSSERVO, DEMO], ids=["busservo", "greenhouse"])
def test_every_file_of_a_library_is_what_a_template_or_the_model_makes(spec: Path) -> None:
    [folder] = {path.rpartition("/")[0] for path in library_of(spec)}
    emitted = {path.removeprefix(f"{folder}/") for path in library_of(spec)}
    templates = {t.relative_to(TARGET / "templates").as_posix()[:-6] for t in TEMPLATES}
    of_a_package = {"README.md", "hatch_build.py", "pyproject.toml"}
    only_some_have = {*of_a_package, "_devices.py", "_async_devices.py"}
    assert emitted <= templates | {"py.typed", "protocol.json"}
    assert templates - emitted <= only_some_have


def test_the_generator_knows_no_protocol_by_name() -> None:
    """Code does not; docstrings, hints and examples of how something is written may."""
    known = {path.relative_to(CODEGEN).as_posix(): words_known(path) for path in SOURCES}
    assert {path: words for path, words in known.items() if words} == {}


FORBIDDEN = re.compile(r"servo|busservo|0x55|\\x55|hiwonder|greenhouse|\bvent", re.IGNORECASE)


def words_known(path: Path) -> list[str]:
    """Return the words of a protocol that a source file names, compares or looks up."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".jinja":
        return FORBIDDEN.findall(text)
    # Most say none of them, not even in a docstring.
    if not FORBIDDEN.search(text) and "5555" not in text and str(0x5555) not in text:
        return []
    code = [*ast.walk(ast.parse(text))]
    names = {node.id for node in code if isinstance(node, ast.Name)}
    names |= {node.attr for node in code if isinstance(node, ast.Attribute)}
    names |= {node.arg for node in code if isinstance(node, ast.arg)}
    names |= {
        node.name
        for node in code
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef)
    }
    # Text that is compared or looked up would be knowledge; text that is shown is an example.
    for node in code:
        compared: list[ast.AST] = []
        if isinstance(node, ast.Compare):
            compared = [node.left, *node.comparators]
        elif isinstance(node, ast.Subscript):
            compared = [node.slice]
        elif isinstance(node, ast.MatchValue):
            compared = [node.value]
        names |= {str(each.value) for each in compared if isinstance(each, ast.Constant)}
    header = {"0x5555" for node in code if isinstance(node, ast.Constant) and node.value == 0x5555}
    return sorted(header.union(name for name in names if FORBIDDEN.search(name)))


def test_words_of_a_protocol_are_found_wherever_code_knows_them(tmp_path: Path) -> None:
    source, template = tmp_path / "some.py", tmp_path / "some.jinja"
    source.write_text(
        '"""Like busservo."""\n\n'
        'def servo_of(vent):\n    return vent.servos[0x5555]["greenhouse"]\n'
        'x = "HIWONDER" == y\nmatch x:\n    case "0x55":\n        print("servo")\n',
        encoding="utf-8",
    )
    assert words_known(source) == [
        *("0x55", "0x5555", "HIWONDER", "greenhouse", "servo_of", "servos", "vent")
    ]
    template.write_text("one {{ servo }}", encoding="utf-8")
    assert words_known(template) == ["servo"]


def test_what_is_emitted_for_every_protocol_names_none() -> None:
    assert len(TEMPLATES) >= 4
    assert len(COMMON) >= 10
    texts = {named(path): path.read_text(encoding="utf-8") for path in [*TEMPLATES, *COMMON]}
    words = re.compile(r"(?i)busservo|hiwonder|greenhouse|lx-?16")
    assert [path for path, text in texts.items() if words.search(text)] == []


PAGES = sorted(
    template
    for folder in ("targets/docs/templates", "site/templates")
    for template in (CODEGEN / folder).glob("*.jinja")
)


@in_turn("template", lambda: [*TEMPLATES, *PAGES])
def test_what_is_kept_of_a_template_holds_nothing_that_a_filter_made(template: Path) -> None:
    """Else a filter that is changed later would still be seen to do what it once did."""
    of_kind = {".html": rendering._environment, ".md": markdown_pages._environment}
    ours = of_kind.get(Path(template.stem).suffix, _environment)()
    root = ours.parse(template.read_text(encoding="utf-8"))
    for output in root.find_all(nodes.Output):
        for node in output.nodes:
            if not isinstance(node, nodes.TemplateData):
                with pytest.raises(nodes.Impossible):
                    node.as_const(nodes.EvalContext(ours))


def test_a_template_is_compiled_once_and_again_when_it_has_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.dont_write_bytecode", False)
    template, kept = tmp_path / "page.jinja", tmp_path / "__pycache__"
    for text in ("one", "two"):
        template.write_text(text, encoding="utf-8")
        for _ in range(2):
            assert environment(tmp_path, "plain").get_template("page.jinja").render() == text
            assert len([*kept.iterdir()]) == 1


def test_templates_that_are_not_or_cannot_be_kept_are_rendered_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "page.jinja").write_text("text", encoding="utf-8")
    # Where Python keeps nothing.
    monkeypatch.setattr("sys.dont_write_bytecode", True)
    assert environment(tmp_path, "plain").get_template("page.jinja").render() == "text"
    assert not (tmp_path / "__pycache__").exists()
    (tmp_path / "__pycache__").write_text("in the way", encoding="utf-8")
    monkeypatch.setattr("sys.dont_write_bytecode", False)
    assert environment(tmp_path, "plain").get_template("page.jinja").render() == "text"


def test_the_library_view_has_every_name_that_templates_use() -> None:
    used = {
        node.attr
        for template in TEMPLATES
        for node in parsed(template).find_all(nodes.Getattr)
        if isinstance(node.node, nodes.Name) and node.node.name == "library"
    }
    view = LibraryView(compiled_file(DEMO).model)
    assert len(used) > 10
    for name in used:
        getattr(view, name)
