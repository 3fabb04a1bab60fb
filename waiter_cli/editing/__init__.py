"""Changes the text of a layout in place: only what an edit is about is written anew.

`layout_file` reads and writes the file itself, `scenario_edits` and `situations` keep in texts what an
explanation proposes.

`edits` has what can be done to a layout, `splices` how a YAML text takes a change, `spans` where its
values stand, `sketch` what can be drawn of a text that is no layout yet, and `mends` the edits that
do away with a remark of `layout check`.
"""
