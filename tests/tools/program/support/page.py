"""A minimal HTML5 parser, to inspect the pages that `lobe` writes."""

from html.parser import HTMLParser

VOID = {"br", "img", "meta", "link", "hr", "input"}


class Element:
    def __init__(self, tag, attributes, parent):
        self.tag, self.attributes, self.parent, self.children = tag, attributes, parent, []

    def all(self, tag, **attributes):
        """All descendants with that tag and these attributes; "class_" means "class"."""
        wanted = {name.rstrip("_"): value for name, value in attributes.items()}
        found = []
        for child in self.children:
            if isinstance(child, Element):
                if child.tag == tag and all(value in child.attributes.get(name, "").split()
                                            for name, value in wanted.items()):
                    found.append(child)
                found += child.all(tag, **attributes)
        return found

    def text(self):
        return "".join(child if isinstance(child, str) else child.text()
                       for child in self.children)

    def walk(self):
        yield self
        for child in self.children:
            if isinstance(child, Element):
                yield from child.walk()


class _Reader(HTMLParser):
    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.root = self.at = Element("", {}, None)

    def handle_starttag(self, tag, attrs):
        assert len(dict(attrs)) == len(attrs), f"an attribute twice in <{tag}>"
        element = Element(tag, dict(attrs), self.at)
        self.at.children.append(element)
        if tag not in VOID:
            self.at = element

    def handle_startendtag(self, tag, attrs):
        self.at.children.append(Element(tag, dict(attrs), self.at))

    def handle_endtag(self, tag):
        assert tag == self.at.tag, f"</{tag}> ends <{self.at.tag}> at {self.getpos()}"
        self.at = self.at.parent

    def handle_data(self, data):
        self.at.children.append(data)


def parse(text):
    """The page as a tree. Fails if tags do not match."""
    reader = _Reader()
    reader.feed(text)
    reader.close()
    assert reader.at is reader.root, f"<{reader.at.tag}> has no end"
    return reader.root


def by_id(root, name):
    found = [element for element in root.walk() if element.attributes.get("id") == name]
    assert len(found) == 1, f"{len(found)} elements are called {name}"
    return found[0]


def rows(table):
    """The body's rows: each cell as a number if it has a machine-readable one, else its text."""
    result = []
    for row in table.all("tbody")[0].all("tr"):
        cells = [cell for cell in row.children if isinstance(cell, Element)]
        result.append([float(cell.all("data")[0].attributes["value"]) if len(cell.all("data")) == 1
                       else cell.text().strip() for cell in cells])
    return result
