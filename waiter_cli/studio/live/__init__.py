"""The room Live: an evening in real time, the lines that people send to it, and what it tells them.

`live_world` lives it, `live_lines` answers what people say, `live_controller` is what its robots report
by, `live_teller` tells the page, with what `plan_list` and `live_view` have it list beside the floor;
`live_record` keeps what happened, `live_sockets` has the clients of ``/live``.
"""
