"""Entry point: a contact, its film, its responses to waves, surfaces inside it."""

from ehlwave.operating_point.contact import Contact, contact_of

__all__ = ["Contact", "contact_of"]
