"""The restaurant as a local page: lived in, laid out, explained.

`server` puts the parts together: `gate` keeps strangers out, `page_files` has what a browser may load,
`page_actions` what it may ask for by POST, `live` the sockets of ``/live`` and the world behind them.  `docs/architecture.md` says how a room of the page is added.
"""
