"""Reading XML with XPath."""

import functools

from lxml import etree

xpath = functools.cache(etree.XPath)


def text(element, path="."):
    """The text of the first element at a path."""
    return xpath(f"string({path})")(element).strip()


def real(value):
    """A real number with all of its digits."""
    mantissa, exponent = f"{value:.16e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def parse(path, recover=False):
    """The root of a file; blanks, comments and the encoding are libxml2's."""
    return etree.fromstring(open(path, "rb").read(), etree.XMLParser(huge_tree=True, recover=recover))


def told(elements):
    """The facts that say something."""
    return {key: {name: fact for name, fact in facts.items() if fact} for key, facts in elements.items()}
