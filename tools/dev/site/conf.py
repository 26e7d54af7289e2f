# SPDX-License-Identifier: BSD-3-Clause
# Sphinx's settings for the site. Nothing in a page is fetched from elsewhere: the theme has no fonts or scripts of others.

from pygments.lexers.special import TextLexer
from sphinx.highlighting import lexers

project = "waitpoint"
copyright = "the contributors"
html_title = "waitpoint"
extensions = ["myst_parser"]
html_theme = "furo"
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
pygments_style = "friendly"
pygments_dark_style = "native"
myst_heading_anchors = 4  # as GitHub names them
suppress_warnings = ["misc.highlighting_failure"]  # outputs in blocks of another language
lexers.update({name: TextLexer() for name in ("ctl", "gen", "walls")})
