"""The clients: sessions, requests, replies and reports, for threads and for asyncio."""
