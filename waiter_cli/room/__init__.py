"""A restaurant in metres: places, shapes, figures, motion and the camera."""
