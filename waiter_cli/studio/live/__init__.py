"""The room Live: an evening in real time, the lines that people send to it, and what it tells them.

`live_world` lives it, `live_controller` is what its robots report by, `plan_list` and `live_view`
say what the page lists beside the floor, `live_sockets` has the clients of ``/live``.
"""
