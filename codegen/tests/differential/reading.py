"""Functions for reading XML with XPath."""

import functools

from lxml import etree

xpath = functools.cache(etree.XPath)


def text(element, path="."):
    """Returns the text of the first element at a path."""
    return xpath(f"string({path})")(element).strip()


def real(value):
    """Formats a real number with all its digits."""
    mantissa, exponent = f"{value:.16e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def parse(path, recover=False):
    """Returns the root of a file. libxml2 handles blanks, comments and the encoding."""
    return etree.fromstring(open(path, "rb").read(), etree.XMLParser(huge_tree=True, recover=recover))


def nonempty(elements):
    """Returns the elements without their empty facts."""
    return {key: {name: fact for name, fact in facts.items() if fact} for key, facts in elements.items()}
