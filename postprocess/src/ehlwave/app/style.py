"""Style of the page. Everything is part of the page itself: nothing is loaded from elsewhere."""

POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' blob:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "connect-src 'self' data: blob:; object-src 'none'; base-uri 'none'; form-action 'none'"
)
"""Allowed sources of a browser: the server itself."""

TEMPLATE = """
{% extends base %}
{% block preamble %}
<meta http-equiv="Content-Security-Policy" content="POLICY">
<meta name="viewport" content="width=device-width, initial-scale=1">
{% endblock %}
{% block postamble %}
<style>
:root { font-family: Helvetica, Arial, sans-serif; font-size: 15px;
  --fields-height: max(360px, calc(100vh - 190px)); }
body { background: #f3f6f8; color: #1b2a33; }
header { background: #14405c; color: white; padding: 10px 20px; }
header h1 { font-size: 1.25rem; margin: 0; display: inline; }
header span { margin-left: 1em; color: #d4e3ec; font-size: 0.92rem; }
main { display: grid; grid-template-columns: minmax(400px, 440px) minmax(0, 1fr); gap: 16px;
  padding: 16px; max-width: 1500px; margin: auto; align-items: start; }
main > section { min-width: 0; background: white; border: 1px solid #d7e0e6; border-radius: 6px;
  padding: 10px 14px; }
footer { padding: 4px 20px 20px; color: #51626c; font-size: 0.85rem; text-align: center; }
@media (max-width: 900px) { main { grid-template-columns: minmax(0, 1fr); padding: 8px; }
  :root { --fields-height: none; } }
@media (max-width: 480px) { main { padding: 4px; } main > section { padding: 6px 2px; } }
</style>
{% endblock %}
{% block contents %}
<header><h1>{{ app_title }}</h1>
<span>Film, friction and roughness in lubricated contacts</span></header>
<main>
<section aria-label="Inputs">{{ embed(roots.inputs) }}</section>
<section aria-label="Answer">{{ embed(roots.answers) }}</section>
</main>
<footer>Computed on the server that sent this page. Nothing is kept, and no other host is
asked.</footer>
{% endblock %}
""".replace("POLICY", POLICY)

OUTPUT = [
    """
:host { font-size: 15px; line-height: 1.45; }
p.answer { font-size: 1.2em; background: #e6eff5; border-left: 5px solid #14405c;
  padding: 10px 14px; margin: 4px 0; }
p.answer.decided { background: #e8f2ea; border-left-color: #2f7d4f; }
p.answer.open { background: #fff4d6; border-left-color: #c98a00; }
p.hint { color: #51626c; margin: 4px 0; }
p.note, p.old { background: #fff4d6; border-left: 5px solid #c98a00;
  padding: 6px 14px; margin: 4px 0; }
div.error { background: #fbe9e7; border-left: 5px solid #b3261e; padding: 10px 14px; margin: 4px 0;
  overflow-wrap: anywhere; }
div.error p { margin: 6px 0 0; }
h3 { font-size: 1.02em; margin: 14px 0 4px; color: #14405c; }
ul { margin: 0; padding-left: 1.3em; }
ul.warning li { color: #8a4b00; }
figure { margin: 10px 0; max-width: 860px; }
figure img { width: 100%; height: auto; }
figcaption { color: #51626c; font-size: 0.9em; }
table { border-collapse: collapse; margin: 12px 0; width: 100%; max-width: 860px; }
caption { text-align: left; font-weight: 600; color: #14405c; padding: 4px 0; }
th, td { text-align: left; font-weight: 400; padding: 3px 10px 3px 0;
  border-bottom: 1px solid #e3eaee;
  vertical-align: top; }
th { color: #51626c; width: 42%; }
td { font-variant-numeric: tabular-nums; }
pre { white-space: pre-wrap; font-size: 0.86em; margin: 0; }
"""
]
