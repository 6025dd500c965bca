"""Whether the user has asked for the end."""

import threading

stopping = threading.Event()
