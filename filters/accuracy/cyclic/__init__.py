"""Any linear filter whose operations repeat: its blocks are stacked, and a cycle is replayed. An oracle of the closed
form, from which nothing is imported here."""
