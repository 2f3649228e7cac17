#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/optional.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace ortung::web {

/// Body of an answer whose bytes others share: however many visitors do not read the page's files,
/// these lie in memory once. Null: there is none.
struct SharedText {
  using value_type = std::shared_ptr<const std::string>;

  static std::uint64_t size(const value_type& text) { return text ? text->size() : 0; }

  class writer {  // NOLINT(readability-identifier-naming): Beast's name
   public:
    using const_buffers_type = boost::asio::const_buffer;

    template <bool isRequest, class Fields>
    writer(const boost::beast::http::header<isRequest, Fields>&, const value_type& text)
        : text_(text) {}
    void init(boost::beast::error_code& error) { error = {}; }
    boost::optional<std::pair<const_buffers_type, bool>> get(boost::beast::error_code& error) {
      error = {};
      if (!text_) return boost::none;
      return {{const_buffers_type(text_->data(), text_->size()), false}};
    }

   private:
    const value_type& text_;
  };
};

}  // namespace ortung::web
