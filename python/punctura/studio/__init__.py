"""The studio: a scene on a device, live in a page of the browser."""
